#pragma once

#include <algorithm>
#include <cstddef>
#include <optional>
#include <string>
#include <utility>

#include "core/types/type_info.h"
#include "plugins/cdr_values/cdr_stream.h"

namespace runnel {

/// What those who walk through octets and the parts of a value side by side have in common: where they are, what went wrong,
/// and how much memory lists may still take. The way to what failed is found on the way back.
class CdrWalk {
 public:
  [[nodiscard]] Error error() const {
    const std::string path = path_.starts_with('.') ? path_.substr(1) : path_;
    return {.message = (path.empty() ? "" : path + ": ") + problem_};
  }

 protected:
  explicit CdrWalk(CdrReader& reader) : reader_(reader), room_(kMostBytes + reader.left()) {}

  bool Fail(std::string problem) {
    problem_ = std::move(problem);
    return false;
  }
  bool IsThere(bool is_there) { return is_there || Fail("the octets end before it does"); }
  /// It failed in this field.
  bool FailIn(const std::string& field) {
    path_.insert(0, "." + field);
    return false;
  }

  /// Of a list whose elements take at least `least` octets each.
  [[nodiscard]] std::optional<std::size_t> GetCount(std::size_t least) {
    auto count = reader_.GetCount(least);
    if (!count) (void)Fail("it claims more elements than there are octets for");
    return count;
  }
  /// Whether so many elements of the type may still be made.
  bool TakeRoom(const TypeInfo& element, std::size_t count) {
    const std::size_t size = std::max<std::size_t>(element.size(), 1);
    if (count > room_ / size) return Fail(std::to_string(count) + " elements are too many");
    room_ -= count * size;
    return true;
  }
  /// Makes the list as long. False if its type cannot be.
  bool Resize(const TypeInfo& type, void* value, std::size_t rows, std::size_t columns) {
    return type.elements().resize(value, rows, columns) ||
           Fail("a " + type.name() + " cannot have " + std::to_string(rows * columns) + " elements");
  }
  /// `read(element)` for each.
  template <typename Read>
  bool ForEach(const TypeInfo& type, void* value, std::size_t count, const Read& read) {
    for (std::size_t i = 0; i < count; ++i) {
      if (read(type.elements().element(value, i))) continue;
      path_.insert(0, "[" + std::to_string(i) + "]");
      return false;
    }
    return true;
  }

  CdrReader& reader_;

 private:
  // Elements may take more in memory than on the wire, but not without an end.
  static constexpr std::size_t kMostBytes = std::size_t{1} << 28;

  std::size_t room_;
  std::string path_;
  std::string problem_;
};

}  // namespace runnel
