#pragma once

#include <cstddef>
#include <optional>
#include <string>
#include <string_view>

#include "core/base/result.h"

namespace runnel {

/// What goes over a control socket, in both directions: "kind length\n", so many bytes, "\n".
struct Frame {
  std::string kind;  ///< a lower-case word
  std::string payload;
};

[[nodiscard]] std::string FrameBytes(std::string_view kind, std::string_view payload);

/// Puts frames together from bytes as they come.
///
/// Threads:  one. Memory: no more than what was added since the last Take(), and one frame.
class FrameReader {
 public:
  static constexpr std::size_t kLongestKind = 16;

  /// Refuses frames with more than `longest` bytes before they have come.
  explicit FrameReader(std::size_t longest) : longest_(longest) {}

  void Add(std::string_view bytes) { bytes_ += bytes; }
  /// The next one, if all of it is there. Errors: what has come is no frame; there is no way on then.
  [[nodiscard]] Result<std::optional<Frame>> Take();
  /// Bytes that belong to no frame yet.
  [[nodiscard]] std::size_t waiting() const noexcept { return bytes_.size() - at_; }

 private:
  const std::size_t longest_;
  std::string bytes_;
  std::size_t at_ = 0;
};

}  // namespace runnel
