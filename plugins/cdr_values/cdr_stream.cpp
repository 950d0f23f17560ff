
#include "plugins/cdr_values/cdr_stream.h"

#include <algorithm>

namespace runnel {

Result<CdrReader> CdrReader::Begin(std::span<const std::byte> octets, std::shared_ptr<const void> holder) {
  constexpr std::size_t kHeader = CdrWriter::kHeader;
  if (octets.size() < kHeader) {
    return Error{.message = "a value in CDR begins with 4 octets, and here are " + std::to_string(octets.size())};
  }
  const auto kind = std::to_integer<unsigned>(octets[0]) << 8 | std::to_integer<unsigned>(octets[1]);
  if (kind > 1) {
    return Error{.message = "the octets are no plain CDR, but of the kind " + std::to_string(kind),
                 .hint = "the writer is to use the data representation XCDR1, as ROS 2 does"};
  }
  // Cyclone says here by how many octets it has made the value longer.
  const std::size_t padding = std::to_integer<std::size_t>(octets[3]) & 3;
  octets = octets.subspan(kHeader);
  octets = octets.first(octets.size() - std::min(padding, octets.size()));
  return CdrReader(octets, (kind == 1) != (std::endian::native == std::endian::little), std::move(holder));
}

const std::byte* CdrReader::Take(std::size_t size, std::size_t count) {
  const std::size_t begin = (place_ + size - 1) / size * size;
  if (begin > octets_.size() || count > (octets_.size() - begin) / size) return nullptr;
  place_ = begin + size * count;
  return octets_.data() + begin;
}

bool CdrReader::GetPlain(void* first, std::size_t size, std::size_t count) {
  if (count == 0) return true;
  const std::byte* const from = Take(size, count);
  if (from == nullptr) return false;
  std::memcpy(first, from, size * count);
  if (!is_swapped_ || size == 1) return true;
  auto* const bytes = static_cast<std::byte*>(first);
  for (std::size_t i = 0; i < count; ++i) std::reverse(bytes + i * size, bytes + (i + 1) * size);
  return true;
}

const std::byte* CdrReader::FindKept(std::size_t size, std::size_t count) {
  const bool is_readable = holder_ != nullptr && (!is_swapped_ || size == 1);
  return is_readable ? Take(size, count) : nullptr;
}

bool CdrReader::GetText(std::string& text) {
  std::uint32_t length = 0;
  if (!Get(length)) return false;
  const std::byte* const from = Take(1, length);
  if (from == nullptr) return false;
  if (length > 0 && from[length - 1] == std::byte{0}) --length;
  text.assign(reinterpret_cast<const char*>(from), length);
  return true;
}

std::optional<std::size_t> CdrReader::GetCount(std::size_t least) {
  std::uint32_t count = 0;
  if (!Get(count) || count > left() / std::max<std::size_t>(least, 1)) return std::nullopt;
  return count;
}

}  // namespace runnel
