#include "plugins/parameters/file_path.h"

#include <cstdint>
#include <vector>

#include "core/types/binary_encoding.h"

namespace runnel {

namespace {

const std::string& TextIn(const void* value) { return static_cast<const FilePath*>(value)->text; }

Result<void> FromText(std::string_view text, void* value) {
  if (text.find('\0') != std::string_view::npos) {
    return Error{.message = "a file name contains no zero byte"};
  }
  static_cast<FilePath*>(value)->text = text;
  return {};
}

void Write(const void* value, BinaryWriter& writer) {
  const std::string& text = TextIn(value);
  writer.WriteUnsigned(static_cast<std::uint32_t>(text.size()));
  writer.WriteBytes(std::as_bytes(std::span(text)));
}

bool Read(BinaryReader& reader, void* value) {
  std::uint32_t size = 0;
  if (!reader.ReadUnsigned(size) || size > reader.remaining()) return false;
  std::string& text = static_cast<FilePath*>(value)->text;
  text.resize(size);
  return reader.ReadBytes(std::as_writable_bytes(std::span(text)));
}

}  // namespace

void Describe(TypeBuilder<FilePath>& type) {
  type.Name("FilePath")
      .Leaf({.to_text = [](const void* value) { return TextIn(value); },
             .from_text = FromText,
             .write = Write,
             .read = Read,
             .needs_quotes = true});
}

FilePath ResolvedAgainst(const std::filesystem::path& folder, const FilePath& file) {
  if (file.empty() || file.path().is_absolute()) return file;
  return {(folder / file.path()).lexically_normal().string()};
}

}  // namespace runnel
