#include "core/log/internal/encoded_message.h"

#include <fmt/args.h>
#include <fmt/format.h>

namespace runnel::internal {

namespace {

template <typename T>
T Take(const std::byte*& from) {
  T value;
  std::memcpy(&value, from, sizeof value);
  from += sizeof value;
  return value;
}

std::string_view TakeText(const std::byte*& from, std::size_t size) {
  const std::string_view text(reinterpret_cast<const char*>(from), size);
  from += size;
  return text;
}

using Arguments = fmt::dynamic_format_arg_store<fmt::format_context>;

void TakeArgument(const std::byte*& from, Arguments& arguments) {
  switch (Take<EncodedMessage::Kind>(from)) {
    case EncodedMessage::Kind::kBool:
      return arguments.push_back(Take<bool>(from));
    case EncodedMessage::Kind::kCharacter:
      return arguments.push_back(Take<char>(from));
    case EncodedMessage::Kind::kSigned:
      return arguments.push_back(Take<std::int64_t>(from));
    case EncodedMessage::Kind::kUnsigned:
      return arguments.push_back(Take<std::uint64_t>(from));
    case EncodedMessage::Kind::kFloat:
      return arguments.push_back(Take<float>(from));
    case EncodedMessage::Kind::kDouble:
      return arguments.push_back(Take<double>(from));
    case EncodedMessage::Kind::kText:
      const auto size = Take<std::uint16_t>(from);
      return arguments.push_back(TakeText(from, size));
  }
}

}  // namespace

std::string EncodedMessage::TextOf(const Header& header, const std::byte* after_header) {
  const std::byte* from = after_header;
  const std::byte* const end = after_header + header.size - sizeof header;
  const std::string_view format = TakeText(from, header.format_size);
  if (header.is_cut) return std::string(format) + " …";
  Arguments arguments;
  while (from < end) TakeArgument(from, arguments);
  try {
    return fmt::vformat(format, arguments);
  } catch (const fmt::format_error&) {  // a width that was an argument and is none
    return std::string(format);
  }
}

}  // namespace runnel::internal
