#include "plugins/wire_shared_memory/segment.h"

#include <bit>
#include <cerrno>
#include <cstring>
#include <new>
#include <string>
#include <utility>

#include <fcntl.h>
#include <sys/mman.h>
#include <sys/random.h>
#include <sys/stat.h>
#include <unistd.h>

#include "core/lockfree/cache_line.h"
#include "plugins/wire_shared_memory/slot_use.h"

namespace runnel {

namespace {

constexpr std::size_t kPage = 4096;
constexpr std::uint64_t kMagic = 0x524e4c5345473031;  // of this layout
// Plain CDR of this machine's, since engines let nothing else pass, with options that nobody has; then what is no length of
// a list or a text, so that who does not know of places finds no value in it.
constexpr std::array<std::byte, 12> kBegin = {std::byte{0},    std::byte{std::endian::native == std::endian::little},
                                              std::byte{0xC0}, std::byte{0x50},
                                              std::byte{0xFF}, std::byte{0xFF}, std::byte{0xFF}, std::byte{0xFF},
                                              std::byte{'P'},  std::byte{'l'},  std::byte{'c'},  std::byte{'e'}};

struct Head {
  std::uint64_t magic = kMagic;
  std::uint64_t room = 0;  // octets of a slot
  struct alignas(kCacheLineSize) Slot {
    SlotUse<> use;
  };
  std::array<Slot, WrittenSegment::kSlots> slots;
};
static_assert(sizeof(Head) <= kPage && std::atomic<std::uint64_t>::is_always_lock_free);

const Head& HeadOf(const std::byte* memory) { return *reinterpret_cast<const Head*>(memory); }

Error SystemError(const char* what) {
  return {.message = std::string(what) + ": " + std::strerror(errno)};
}

constexpr int kSeals = F_SEAL_SHRINK | F_SEAL_GROW | F_SEAL_SEAL;

}  // namespace

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

Descriptor::~Descriptor() {
  if (is_open()) close(number_);
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
  if (octets.size() < kBegin.size() ||
      std::memcmp(octets.data(), kBegin.data(), kBegin.size()) != 0) {
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

WrittenSegment::WrittenSegment(Descriptor file, std::byte* memory, std::size_t room)
    : file_(std::move(file)), memory_(memory), room_(room) {
  auto* const head = new (memory_) Head;
  head->room = room;
}

Result<std::unique_ptr<WrittenSegment>> WrittenSegment::Make(std::size_t room) {
  room = (room + kPage - 1) / kPage * kPage;
  const std::size_t size = kPage + kSlots * room;
  Descriptor file(memfd_create("runnel values", MFD_CLOEXEC | MFD_ALLOW_SEALING));
  if (!file.is_open() || ftruncate(file.number(), static_cast<off_t>(size)) != 0) return SystemError("there is no shared memory");
  void* const memory = mmap(nullptr, size, PROT_READ | PROT_WRITE, MAP_SHARED, file.number(), 0);
  if (memory == MAP_FAILED) return SystemError("there is no shared memory");
  std::unique_ptr<WrittenSegment> made(new WrittenSegment(std::move(file), static_cast<std::byte*>(memory), room));
#ifdef F_SEAL_FUTURE_WRITE
  constexpr int kWanted = kSeals | F_SEAL_FUTURE_WRITE;  // nobody else gets it to write to
#else
  constexpr int kWanted = kSeals;
#endif
  if (fcntl(made->descriptor(), F_ADD_SEALS, kWanted) != 0) return SystemError("shared memory cannot be sealed");
  return made;
}

WrittenSegment::~WrittenSegment() { munmap(memory_, kPage + kSlots * room_); }

SegmentPlace WrittenSegment::Put(std::span<const std::byte> octets) noexcept {
  const auto slot = static_cast<std::uint32_t>(count_ % kSlots);
  const std::uint64_t use = 2 * (count_ / kSlots + 1);
  ++count_;
  SlotUse<>& used = reinterpret_cast<Head*>(memory_)->slots[slot].use;
  used.BeginWriting(use);
  std::memcpy(memory_ + kPage + slot * room_, octets.data(), octets.size());
  used.EndWriting(use);
  return {.segment = id_, .use = use, .size = octets.size(), .slot = slot};
}

Result<std::unique_ptr<ReadSegment>> ReadSegment::Map(const Descriptor& file) {
  struct stat about {};
  const int seals = fcntl(file.number(), F_GET_SEALS);
  // Else who has it could make it shorter, and end whoever reads.
  if (seals < 0 || (seals & F_SEAL_SHRINK) == 0 || fstat(file.number(), &about) != 0) {
    return Error{.message = "what was offered is no memory for values"};
  }
  const auto size = static_cast<std::size_t>(about.st_size);
  if (size < kPage) return Error{.message = "what was offered is no memory for values"};
  void* const memory = mmap(nullptr, size, PROT_READ, MAP_SHARED, file.number(), 0);
  if (memory == MAP_FAILED) return SystemError("shared memory cannot be read");
  const Head& head = HeadOf(static_cast<const std::byte*>(memory));
  const std::uint64_t room = head.room;
  std::unique_ptr<ReadSegment> mapped(new ReadSegment(static_cast<const std::byte*>(memory), size, room));
  if (head.magic != kMagic || room > size || kPage + WrittenSegment::kSlots * room != size) {
    return Error{.message = "what was offered is no memory for values"};
  }
  return mapped;
}

ReadSegment::~ReadSegment() { munmap(const_cast<std::byte*>(memory_), size_); }

std::optional<std::span<const std::byte>> ReadSegment::Find(const SegmentPlace& place) const noexcept {
  if (place.slot >= WrittenSegment::kSlots || place.size > room_ || place.use % 2 != 0) return {};
  if (!HeadOf(memory_).slots[place.slot].use.Is(place.use)) return {};
  return std::span(memory_ + kPage + place.slot * room_, place.size);
}

bool ReadSegment::IsStill(const SegmentPlace& place) const noexcept {
  return HeadOf(memory_).slots[place.slot].use.IsStill(place.use);
}

}  // namespace runnel
