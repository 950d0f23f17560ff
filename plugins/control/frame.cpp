#include "plugins/control/frame.h"

#include <algorithm>

#include "core/base/number_text.h"

namespace runnel {

namespace {

constexpr std::size_t kLongestHeader = FrameReader::kLongestKind + 1 + 20;

bool IsKind(std::string_view text) {
  return !text.empty() && text.size() <= FrameReader::kLongestKind &&
         std::ranges::all_of(text,
                             [](char character) { return character >= 'a' && character <= 'z'; });
}

Error NoFrame(std::string what) {
  return {.message = std::move(what), .hint = "a frame is 'kind length', its bytes, end of line"};
}

}  // namespace

std::string FrameBytes(std::string_view kind, std::string_view payload) {
  std::string bytes;
  bytes.reserve(kind.size() + payload.size() + 24);
  bytes.append(kind).append(" ").append(std::to_string(payload.size())).append("\n");
  return bytes.append(payload).append("\n");
}

Result<std::optional<Frame>> FrameReader::Take() {
  const std::string_view rest = std::string_view(bytes_).substr(at_);
  const std::size_t end = rest.substr(0, kLongestHeader + 1).find('\n');
  if (end == std::string_view::npos) {
    if (rest.size() > kLongestHeader) return NoFrame("what came does not begin with a header");
    return std::optional<Frame>();
  }
  const std::string_view header = rest.substr(0, end);
  const std::size_t blank = std::min(header.find(' '), header.size());
  const auto length = NumberIn<std::size_t>(header.substr(std::min(blank + 1, header.size())));
  if (!IsKind(header.substr(0, blank)) || !length) return NoFrame("what came has no good header");
  if (*length > longest_) {
    return NoFrame("a frame of " + std::to_string(*length) + " bytes is too long; " +
                   std::to_string(longest_) + " are taken");
  }
  if (rest.size() < end + *length + 2) return std::optional<Frame>();
  if (rest[end + 1 + *length] != '\n')
    return NoFrame("a frame does not end where it said it would");
  Frame frame{std::string(header.substr(0, blank)), std::string(rest.substr(end + 1, *length))};
  at_ += end + *length + 2;
  if (at_ == bytes_.size() || at_ > longest_) {
    bytes_.erase(0, at_);
    at_ = 0;
  }
  return std::optional<Frame>(std::move(frame));
}

}  // namespace runnel
