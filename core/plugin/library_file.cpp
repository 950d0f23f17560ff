#include "core/plugin/library_file.h"

#include <algorithm>
#include <cstring>
#include <fstream>
#include <string>
#include <vector>

#include <link.h>

namespace runnel {

namespace {

using Head = ElfW(Ehdr);
using Segment = ElfW(Phdr);
using Section = ElfW(Shdr);

// Empty if not all of them are there.
template <typename T>
std::vector<T> ReadAt(std::ifstream& file, std::uint64_t place, std::size_t count) {
  std::vector<T> read(count);
  file.clear();
  file.seekg(static_cast<std::streamoff>(place));
  file.read(reinterpret_cast<char*>(read.data()), static_cast<std::streamsize>(count * sizeof(T)));
  if (!file) read.clear();
  return read;
}

}  // namespace

Result<void> CheckIsWhole(const std::filesystem::path& path) {
  std::error_code failed;
  const std::uint64_t size = std::filesystem::file_size(path, failed);
  std::ifstream file(path, std::ios::binary);
  if (failed || !file) return Error{.message = "it cannot be read"};
  const Error cut{.message = "it is cut short, or has not been written to its end yet",
                  .hint = "copy it under another name, and rename it when it is whole, as 'install' does"};
  const auto is_inside = [size](std::uint64_t place, std::uint64_t length) { return place <= size && length <= size - place; };
  char begin[SELFMAG] = {};
  file.read(begin, SELFMAG);
  if (std::memcmp(begin, ELFMAG, static_cast<std::size_t>(file.gcount())) != 0) return Error{.message = "it is no ELF file"};
  const auto head = ReadAt<Head>(file, 0, 1);
  if (head.empty()) return cut;
  constexpr unsigned char kOwnClass = sizeof(void*) == 8 ? ELFCLASS64 : ELFCLASS32;
  if (head[0].e_ident[EI_CLASS] != kOwnClass) return {};  // of another kind of machine: the linker looks no further, and says so
  const auto segments = ReadAt<Segment>(file, head[0].e_phoff, head[0].e_phnum);
  const auto has_segment = [&](const Segment& each) { return is_inside(each.p_offset, each.p_filesz); };
  if (segments.empty() || !std::ranges::all_of(segments, has_segment)) return cut;
  // Linkers write these last, at the end; a library may do without any.
  const auto sections = ReadAt<Section>(file, head[0].e_shoff, head[0].e_shnum);
  const auto has_section = [&](const Section& each) { return each.sh_type == SHT_NOBITS || is_inside(each.sh_offset, each.sh_size); };
  if (sections.size() != head[0].e_shnum || !std::ranges::all_of(sections, has_section)) return cut;
  const std::size_t names = head[0].e_shstrndx;
  if (names != SHN_UNDEF && names < sections.size() && sections[names].sh_type != SHT_STRTAB) return cut;
  return {};
}

}  // namespace runnel
