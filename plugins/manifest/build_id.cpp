#include <cstring>
#include <fstream>
#include <string_view>

#include <elf.h>
#include <fmt/format.h>
#include <link.h>

#include "plugins/manifest/plugin_manifest.h"

namespace runnel {

namespace {

using Header = ElfW(Ehdr);
using Segment = ElfW(Phdr);
using Note = ElfW(Nhdr);
constexpr std::size_t kMostBytes = 1 << 16;  // no header or note is longer

/// Reads pieces of a file; what is not there is nothing.
class FileReader {
 public:
  explicit FileReader(const std::filesystem::path& file) : stream_(file, std::ios::binary) {}

  [[nodiscard]] std::string Bytes(std::size_t place, std::size_t count) {
    if (count > kMostBytes) return {};
    std::string bytes(count, '\0');
    stream_.clear();
    stream_.seekg(static_cast<std::streamoff>(place));
    if (!stream_.read(bytes.data(), static_cast<std::streamsize>(count))) return {};
    return bytes;
  }
  template <typename T>
  [[nodiscard]] bool Get(std::size_t place, T& value) {
    const std::string bytes = Bytes(place, sizeof(T));
    if (bytes.empty()) return false;
    std::memcpy(&value, bytes.data(), sizeof(T));
    return true;
  }

 private:
  std::ifstream stream_;
};

std::size_t Aligned(std::size_t size) { return (size + 3) & ~std::size_t{3}; }

// A segment of notes: each a head, a name and what it says, both filled up to words.
std::string BuildIdIn(std::string_view notes) {
  while (notes.size() >= sizeof(Note)) {
    Note note;
    std::memcpy(&note, notes.data(), sizeof(Note));
    notes.remove_prefix(sizeof(Note));
    const std::size_t name = Aligned(note.n_namesz);
    const std::size_t length = Aligned(note.n_descsz);
    if (name > notes.size() || length > notes.size() - name) return {};
    const bool is_of_linker = notes.substr(0, note.n_namesz) == std::string_view("GNU\0", 4);
    if (is_of_linker && note.n_type == NT_GNU_BUILD_ID) {
      std::string text;
      for (const char byte : notes.substr(name, note.n_descsz)) {
        text += fmt::format("{:02x}", static_cast<unsigned char>(byte));
      }
      return text;
    }
    notes.remove_prefix(name + length);
  }
  return {};
}

}  // namespace

Result<std::string> BuildIdOf(const std::filesystem::path& library) {
  FileReader reader(library);
  Header header;
  if (!reader.Get(0, header) || std::memcmp(header.e_ident, ELFMAG, SELFMAG) != 0) {
    return Error{.message = library.string() + " is no library that could be read"};
  }
  for (std::size_t i = 0; i < header.e_phnum; ++i) {
    Segment segment;
    if (!reader.Get(header.e_phoff + i * sizeof(Segment), segment)) break;
    if (segment.p_type != PT_NOTE) continue;
    std::string id = BuildIdIn(reader.Bytes(segment.p_offset, segment.p_filesz));
    if (!id.empty()) return id;
  }
  return Error{.message = library.string() + " has no build id",
               .hint = "link it with -Wl,--build-id"};
}

}  // namespace runnel
