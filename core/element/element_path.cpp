#include "core/element/element_path.h"

#include <algorithm>

#include "core/base/characters.h"

namespace runnel {

namespace {

constexpr std::string_view kWhitespace = " \t\r\n";

// What most names are made of.
bool IsPlain(char character) noexcept {
  return (character >= 'a' && character <= 'z') || (character >= 'A' && character <= 'Z') ||
         (character >= '0' && character <= '9') || character == '_';
}

}  // namespace

Result<void> CheckElementName(std::string_view name) {
  if (!name.empty() && std::ranges::all_of(name, IsPlain)) return {};
  if (name.empty()) return Error{.message = "a name must not be empty"};
  const std::string quoted = "'" + std::string(name) + "'";
  if (name == "." || name == "..") return Error{.message = "the name " + quoted + " is reserved"};
  // Not quoted: terminals would do what it says.
  if (const std::string fault = UnwritableCharacter(name); !fault.empty()) {
    return Error{.message = "a name contains " + fault};
  }
  for (std::size_t i = 0; i < name.size(); ++i) {
    const auto byte = static_cast<unsigned char>(name[i]);
    if (byte == '/') {
      return Error{.message = "the name " + quoted + " contains a '/', which separates names in paths"};
    }
    if (byte == ',' || kWhitespace.find(name[i]) != std::string_view::npos) {
      return Error{.message = "the name " + quoted + " contains a " + (byte == ',' ? "comma" : "blank") +
                              ", which separates paths",
                   .hint = "write '_' instead"};
    }
    const bool is_late_control = byte == 0xc2 && static_cast<unsigned char>(name[i + 1]) < 0xa0;
    if (byte == 0x7f || is_late_control) return Error{.message = "a name contains a control character"};
  }
  return {};
}

std::vector<std::string_view> SplitPath(std::string_view path) { return PartsBetween("/", path); }

}  // namespace runnel
