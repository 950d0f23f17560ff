#include "plugins/wire_shared_memory/hold_table.h"

#include <algorithm>
#include <cerrno>
#include <cstring>
#include <string>
#include <utility>

#include <sys/mman.h>
#include <sys/stat.h>
#include <unistd.h>

namespace runnel {

namespace {

constexpr std::size_t kSize = sizeof(SlotHold<>) * kSlots;

}  // namespace

Error SystemError(const char* what) { return {.message = std::string(what) + ": " + std::strerror(errno)}; }

Descriptor::~Descriptor() {
  if (is_open()) close(number_);
}

Result<std::shared_ptr<HoldTable>> HoldTable::Make() {
  Descriptor file(memfd_create("runnel holds", MFD_CLOEXEC | MFD_ALLOW_SEALING));
  if (!file.is_open() || ftruncate(file.number(), kSize) != 0 || fcntl(file.number(), F_ADD_SEALS, kSeals) != 0) {
    return SystemError("there is no shared memory");
  }
  auto mapped = Map(std::move(file));
  if (!mapped) return mapped.error();
  return std::shared_ptr<HoldTable>(std::move(*mapped));
}

Result<std::unique_ptr<HoldTable>> HoldTable::Map(Descriptor file) {
  struct stat about {};
  const int seals = fcntl(file.number(), F_GET_SEALS);
  if (seals < 0 || (seals & F_SEAL_SHRINK) == 0 || fstat(file.number(), &about) != 0 || about.st_size != kSize) {
    return Error{.message = "what was offered is no memory to hold values by"};
  }
  void* const memory = mmap(nullptr, kSize, PROT_READ | PROT_WRITE, MAP_SHARED, file.number(), 0);
  if (memory == MAP_FAILED) return SystemError("shared memory cannot be written to");
  // All zero, as the system makes it, they hold nothing.
  return std::unique_ptr<HoldTable>(new HoldTable(std::move(file), static_cast<SlotHold<>*>(memory)));
}

HoldTable::~HoldTable() { munmap(holds_, kSize); }

void SegmentHolders::Add(std::shared_ptr<const HoldTable> table) {
  const std::lock_guard lock(mutex_);
  tables_.push_back(std::move(table));
}

void SegmentHolders::Remove(const HoldTable& table) {
  const std::lock_guard lock(mutex_);
  std::erase_if(tables_, [&](const auto& each) { return each.get() == &table; });
}

std::size_t SegmentHolders::count() const noexcept {
  const std::lock_guard lock(mutex_);
  return tables_.size();
}

bool SegmentHolders::Hold(std::uint32_t slot) const noexcept {
  const std::lock_guard lock(mutex_);
  return std::ranges::any_of(tables_, [&](const auto& each) { return (*each)[slot].is_held(); });
}

}  // namespace runnel
