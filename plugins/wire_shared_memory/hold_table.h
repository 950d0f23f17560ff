#pragma once

#include <cstddef>
#include <cstdint>
#include <memory>
#include <mutex>
#include <vector>

#include <fcntl.h>

#include "core/base/result.h"
#include "plugins/wire_shared_memory/slot_hold.h"

namespace runnel {

/// Slots of a segment.
inline constexpr std::uint32_t kSlots = 64;
/// Of memory that others have open as well: nobody makes it shorter, which would end whoever looks.
inline constexpr int kSeals = F_SEAL_SHRINK | F_SEAL_GROW | F_SEAL_SEAL;

/// An open file of this process, closed with it.
class Descriptor {
 public:
  explicit Descriptor(int number = -1) noexcept : number_(number) {}
  Descriptor(Descriptor&& from) noexcept : number_(from.number_) { from.number_ = -1; }
  Descriptor& operator=(Descriptor&&) = delete;
  ~Descriptor();
  [[nodiscard]] int number() const noexcept { return number_; }
  [[nodiscard]] bool is_open() const noexcept { return number_ >= 0; }

 private:
  int number_;
};

/// Which slots of a segment one reader holds: a page of memory of its own, which the writer made and looks at.
class HoldTable {
 public:
  /// By the writer. Errors: of the system.
  static Result<std::shared_ptr<HoldTable>> Make();
  /// By the reader. Errors: it is no such memory, whoever has made it.
  static Result<std::unique_ptr<HoldTable>> Map(Descriptor file);
  ~HoldTable();
  HoldTable(const HoldTable&) = delete;
  HoldTable& operator=(const HoldTable&) = delete;

  [[nodiscard]] int descriptor() const noexcept { return file_.number(); }
  [[nodiscard]] SlotHold<>& operator[](std::uint32_t slot) const noexcept { return holds_[slot]; }

 private:
  HoldTable(Descriptor file, SlotHold<>* holds) : file_(std::move(file)), holds_(holds) {}

  const Descriptor file_;
  SlotHold<>* const holds_;
};

/// The readers of a segment, as its writer sees them. Threads: any.
class SegmentHolders {
 public:
  void Add(std::shared_ptr<const HoldTable> table);
  /// Of a reader that has ended, or reads no more: it holds nothing.
  void Remove(const HoldTable& table);
  [[nodiscard]] bool Hold(std::uint32_t slot) const noexcept;
  [[nodiscard]] std::size_t count() const noexcept;

 private:
  mutable std::mutex mutex_;
  std::vector<std::shared_ptr<const HoldTable>> tables_;
};

/// "WHAT: why" of the last call of the system.
[[nodiscard]] Error SystemError(const char* what);

}  // namespace runnel
