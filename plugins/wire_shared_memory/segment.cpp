#include "plugins/wire_shared_memory/segment.h"

#include <bit>
#include <cstring>
#include <new>

#include <sys/mman.h>
#include <sys/random.h>
#include <sys/stat.h>
#include <unistd.h>

#include "core/lockfree/cache_line.h"

namespace runnel {

namespace {

constexpr std::size_t kSize = sizeof(SlotHold<>) * kSlots;

constexpr std::size_t kPage = 4096;
constexpr std::size_t kHead = 2 * kPage;              // in front of the slots
constexpr std::uint64_t kMagic = 0x524e4c5345473032;  // of this layout
// Plain CDR of this machine's, since engines let nothing else pass, with options that nobody has; then what is no length of
// a list or a text, so that who does not know of places finds no value in it.
constexpr std::array<std::byte, 12> kBegin = {std::byte{0},    std::byte{std::endian::native == std::endian::little},
                                              std::byte{0xC0}, std::byte{0x50},
                                              std::byte{0xFF}, std::byte{0xFF},
                                              std::byte{0xFF}, std::byte{0xFF},
                                              std::byte{'P'},  std::byte{'l'},
                                              std::byte{'c'},  std::byte{'e'}};

struct Head {
  std::uint64_t magic = kMagic;
  std::uint64_t slot_size = 0;
  struct alignas(kCacheLineSize) Slot {
    SlotUse<> use;
  };
  std::array<Slot, kSlots> slots;
};
static_assert(sizeof(Head) <= kHead && std::atomic<std::uint64_t>::is_always_lock_free);

const Head& HeadOf(const std::byte* memory) { return *reinterpret_cast<const Head*>(memory); }

// In each slot: behind the four octets of its encapsulation a value begins on a multiple of 64.
constexpr std::size_t kLead = 60;

std::size_t BeginOf(std::uint32_t slot, std::size_t slot_size) { return kHead + slot * slot_size + kLead; }

}  // namespace

Result<std::shared_ptr<HoldTable>> HoldTable::Make() {
  FileDescriptor file(memfd_create("runnel holds", MFD_CLOEXEC | MFD_ALLOW_SEALING));
  if (!file.is_open() || ftruncate(file.number(), kSize) != 0 || fcntl(file.number(), F_ADD_SEALS, kSeals) != 0) {
    return SystemError("there is no shared memory");
  }
  auto mapped = Map(std::move(file));
  if (!mapped) return mapped.error();
  return std::shared_ptr<HoldTable>(std::move(*mapped));
}

Result<std::unique_ptr<HoldTable>> HoldTable::Map(FileDescriptor file) {
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

SegmentId NewSegmentId() {
  SegmentId id{};
  if (getrandom(id.data(), id.size(), 0) != static_cast<ssize_t>(id.size())) {
    // Before there is randomness: whoever takes the same one is asked by its own server's name.
    static std::atomic<std::uint64_t> made{0};
    const std::array<std::uint64_t, 2> instead = {static_cast<std::uint64_t>(getpid()), made.fetch_add(1)};
    std::memcpy(id.data(), instead.data(), sizeof instead);
  }
  return id;
}

std::shared_ptr<const Octets> SegmentPlace::ToOctets() const {
  Octets octets(kBegin.begin(), kBegin.end());
  const auto append = [&](const auto& part) {
    const auto* const begin = reinterpret_cast<const std::byte*>(&part);
    octets.insert(octets.end(), begin, begin + sizeof part);
  };
  append(server);
  append(segment);
  append(use);
  append(size);
  append(slot);
  return std::make_shared<const Octets>(std::move(octets));
}

std::optional<SegmentPlace> SegmentPlace::In(std::span<const std::byte> octets) {
  SegmentPlace place;
  if (octets.size() < kBegin.size() || std::memcmp(octets.data(), kBegin.data(), kBegin.size()) != 0) {
    return {};
  }
  octets = octets.subspan(kBegin.size());
  const auto take = [&](auto& part) {
    if (octets.size() < sizeof part) return;
    std::memcpy(&part, octets.data(), sizeof part);
    octets = octets.subspan(sizeof part);
  };
  take(place.server);
  take(place.segment);
  take(place.use);
  take(place.size);
  take(place.slot);
  return place;
}

WrittenSegment::WrittenSegment(FileDescriptor file, std::byte* memory, std::size_t slot_size)
    : file_(std::move(file)), memory_(memory), slot_size_(slot_size) {
  (new (memory_) Head)->slot_size = slot_size;
}

Result<std::unique_ptr<WrittenSegment>> WrittenSegment::Make(std::size_t room) {
  const std::size_t slot_size = (kLead + room + kPage - 1) / kPage * kPage;
  const std::size_t size = kHead + kSlots * slot_size;
  FileDescriptor file(memfd_create("runnel values", MFD_CLOEXEC | MFD_ALLOW_SEALING));
  if (!file.is_open() || ftruncate(file.number(), static_cast<off_t>(size)) != 0)
    return SystemError("there is no shared memory");
  void* const memory = mmap(nullptr, size, PROT_READ | PROT_WRITE, MAP_SHARED, file.number(), 0);
  if (memory == MAP_FAILED) return SystemError("there is no shared memory");
  std::unique_ptr<WrittenSegment> made(new WrittenSegment(std::move(file), static_cast<std::byte*>(memory), slot_size));
#ifdef F_SEAL_FUTURE_WRITE
  constexpr int kWanted = kSeals | F_SEAL_FUTURE_WRITE;  // nobody else gets it to write to
#else
  constexpr int kWanted = kSeals;
#endif
  if (fcntl(made->descriptor(), F_ADD_SEALS, kWanted) != 0) return SystemError("shared memory cannot be sealed");
  return made;
}

WrittenSegment::~WrittenSegment() { munmap(memory_, kHead + kSlots * slot_size_); }

std::size_t WrittenSegment::room() const noexcept { return slot_size_ - kLead; }

std::optional<std::uint32_t> WrittenSegment::FindSlot(std::uint64_t use) noexcept {
  auto& slots = reinterpret_cast<Head*>(memory_)->slots;
  const auto mark = [&](std::uint32_t slot) {
    return slots[slot].use.BeginWriting(use, [&] { return holders_->Hold(slot); });
  };
  // Again where a reader has come first: to a value as old as that, one at most for each slot.
  for (std::uint32_t tries = 0; tries < kSlots; ++tries) {
    std::uint32_t free = 0, oldest = 0;
    for (std::uint32_t slot = 0; slot < in_use_; ++slot) {
      if (holders_->Hold(slot)) continue;
      if (free++ == 0 || uses_[slot] < uses_[oldest]) oldest = slot;
    }
    if (free < kSpare && in_use_ < kSlots)
      oldest = in_use_++;
    else if (free == 0)
      return {};
    if (mark(oldest)) return oldest;
  }
  return {};
}

std::optional<SegmentPlace> WrittenSegment::Put(std::span<const std::byte> octets) noexcept {
  const std::uint64_t use = 2 * (count_ + 1);
  const auto slot = FindSlot(use);
  if (!slot) return {};
  ++count_;
  std::memcpy(memory_ + BeginOf(*slot, slot_size_), octets.data(), octets.size());
  reinterpret_cast<Head*>(memory_)->slots[*slot].use.EndWriting(use);
  uses_[*slot] = use;
  return SegmentPlace{.segment = id_, .use = use, .size = octets.size(), .slot = *slot};
}

ReadSegment::ReadSegment(const std::byte* memory, std::size_t size, std::unique_ptr<HoldTable> holds,
                         FileDescriptor link)
    : memory_(memory), size_(size), holds_(std::move(holds)), link_(std::move(link)) {}

Result<std::shared_ptr<ReadSegment>> ReadSegment::Map(const FileDescriptor& file, std::unique_ptr<HoldTable> holds,
                                                      FileDescriptor link) {
  const Error none{.message = "what was offered is no memory for values"};
  struct stat about {};
  const int seals = fcntl(file.number(), F_GET_SEALS);
  // Else who has it could make it shorter, and end whoever reads.
  if (seals < 0 || (seals & F_SEAL_SHRINK) == 0 || fstat(file.number(), &about) != 0) return none;
  const auto size = static_cast<std::size_t>(about.st_size);
  if (size < kHead) return none;
  void* const memory = mmap(nullptr, size, PROT_READ, MAP_SHARED, file.number(), 0);
  if (memory == MAP_FAILED) return SystemError("shared memory cannot be read");
  const auto* const begin = static_cast<const std::byte*>(memory);
  std::shared_ptr<ReadSegment> mapped(new ReadSegment(begin, size, std::move(holds), std::move(link)));
  const std::uint64_t slot_size = HeadOf(begin).slot_size;
  if (HeadOf(begin).magic != kMagic || slot_size <= kLead || slot_size > size || kHead + kSlots * slot_size != size)
    return none;
  mapped->slot_size_ = slot_size;
  return mapped;
}

ReadSegment::~ReadSegment() { munmap(const_cast<std::byte*>(memory_), size_); }

std::shared_ptr<const std::byte> ReadSegment::Hold(const SegmentPlace& place) {
  if (place.slot >= kSlots || place.size > slot_size_ - kLead || place.use % 2 != 0 || place.use == 0) return {};
  if (!(*holds_)[place.slot].Take(HeadOf(memory_).slots[place.slot].use, place.use)) return {};
  held_.fetch_add(1, std::memory_order_relaxed);
  return {memory_ + BeginOf(place.slot, slot_size_),
          [self = shared_from_this(), slot = place.slot](const std::byte*) { self->GiveBack(slot); }};
}

void ReadSegment::GiveBack(std::uint32_t slot) noexcept {
  (*holds_)[slot].GiveBack();
  held_.fetch_sub(1, std::memory_order_relaxed);
}

}  // namespace runnel
