#include "core/plugin/library_file.h"

#include <algorithm>
#include <cstring>
#include <fstream>
#include <string>
#include <vector>

#include <link.h>

namespace runnel {

namespace {

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
  char begin[SELFMAG] = {};
  file.read(begin, SELFMAG);
  if (std::memcmp(begin, ELFMAG, static_cast<std::size_t>(file.gcount())) != 0) return Error{.message = "it is no ELF file"};
  const auto head = ReadAt<ElfW(Ehdr)>(file, 0, 1);
  if (head.empty()) return cut;
  constexpr unsigned char kOwnClass = sizeof(void*) == 8 ? ELFCLASS64 : ELFCLASS32;
  if (head[0].e_ident[EI_CLASS] != kOwnClass) return {};  // of another kind of machine: the linker looks no further, and says so
  const auto segments = ReadAt<ElfW(Phdr)>(file, head[0].e_phoff, head[0].e_phnum);
  const auto is_there = [size](const auto& each) { return each.p_offset <= size && each.p_filesz <= size - each.p_offset; };
  if (segments.empty() || !std::ranges::all_of(segments, is_there)) return cut;
  // Linkers write these last, at the end; a library may do without any.
  const auto sections = ReadAt<ElfW(Shdr)>(file, head[0].e_shoff, head[0].e_shnum);
  if (sections.size() != head[0].e_shnum) return cut;
  const std::size_t names = head[0].e_shstrndx;
  if (names != SHN_UNDEF && names < sections.size() && sections[names].sh_type != SHT_STRTAB) return cut;
  return {};
}

}  // namespace runnel
