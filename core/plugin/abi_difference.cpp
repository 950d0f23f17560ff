#include "core/plugin/abi_difference.h"

#include <algorithm>
#include <array>
#include <cstdlib>
#include <cstring>
#include <fstream>
#include <set>
#include <span>
#include <vector>

#include <elf.h>
#include <fcntl.h>
#include <link.h>
#include <sys/mman.h>
#include <sys/stat.h>
#include <unistd.h>

#include "core/base/characters.h"
#include "core/base/file_descriptor.h"

namespace runnel {

namespace {

// A word that a flag of the compiler puts into a fingerprint.
struct Flag {
  std::string_view word;
  std::string_view what;
  std::string_view names;
};

// Of each kind at most one is in a fingerprint.
constexpr std::array<std::array<Flag, 2>, 3> kKinds{{
    {{{"avx512", "for AVX-512", "-march=native, -mavx512f and the like"},
      {"avx", "for AVX", "-march=native, -mavx and the like"}}},
    {{{"thread-sanitizer", "with ThreadSanitizer", "-fsanitize=thread"},
      {"address-sanitizer", "with AddressSanitizer", "-fsanitize=address"}}},
    {{{"debug", "with the debug mode of the standard library", "-D_GLIBCXX_DEBUG"}, {}}},
}};

const Flag* FlagIn(const std::array<Flag, 2>& kind, std::string_view fingerprint) {
  const std::vector<std::string_view> words = PartsBetween(" ", fingerprint);
  const auto found = std::ranges::find_if(
      kind, [&](const Flag& flag) { return !flag.word.empty() && std::ranges::count(words, flag.word) > 0; });
  return found == kind.end() ? nullptr : &*found;
}

std::string WithoutFlags(std::string_view fingerprint) {
  std::string rest;
  for (const std::string_view word : PartsBetween(" ", fingerprint)) {
    const bool is_flag =
        std::ranges::any_of(kKinds, [&](const auto& kind) { return std::ranges::count(kind, word, &Flag::word) > 0; });
    if (!is_flag) rest += (rest.empty() ? "" : " ") + std::string(word);
  }
  return rest;
}

void Add(std::string& text, const std::string& more) { text += (text.empty() ? "" : "; ") + more; }

void Compare(const Flag* plugin, const Flag* core, AbiDifference& difference) {
  if (plugin == core) return;
  const std::string with = "build the plugin with " + std::string(core != nullptr ? core->names : "");
  if (plugin == nullptr) {
    Add(difference.why, "this core is built " + std::string(core->what) + ", the plugin is not");
    Add(difference.cure, with + ", as this core is");
  } else if (core == nullptr) {
    Add(difference.why, "it is built " + std::string(plugin->what) + ", this core is not");
    Add(difference.cure, "build the plugin without " + std::string(plugin->names) + ", or Runnel with the same flags");
  } else {
    Add(difference.why, "it is built " + std::string(plugin->what) + ", this core " + std::string(core->what));
    Add(difference.cure, with + ", as this core is");
  }
}

namespace fs = std::filesystem;
using Segment = ElfW(Phdr);

// Not by std::memcmp, which AddressSanitizer watches: it would refuse the red zones of the library's own data.
[[gnu::no_sanitize_address]] bool IsSame(std::span<const char> file, const char* in_memory) {
  for (std::size_t i = 0; i < file.size(); ++i) {
    if (file[i] != in_memory[i]) return false;
  }
  return true;
}

/// A library as it is on disk. Whatever is in the file, nothing outside of it is read.
class LibraryFile {
 public:
  // Mapped, since most of a file may be what debuggers read.
  explicit LibraryFile(const fs::path& file) {
    const FileDescriptor opened(open(file.c_str(), O_RDONLY | O_CLOEXEC));
    struct stat status {};
    if (opened.is_open() && fstat(opened.number(), &status) == 0 && status.st_size > 0) {
      const auto size = static_cast<std::size_t>(status.st_size);
      void* const bytes = mmap(nullptr, size, PROT_READ, MAP_PRIVATE, opened.number(), 0);
      if (bytes != MAP_FAILED) bytes_ = {static_cast<const char*>(bytes), size};
    }
  }
  ~LibraryFile() {
    if (!bytes_.empty()) munmap(const_cast<char*>(bytes_.data()), bytes_.size());
  }
  LibraryFile(const LibraryFile&) = delete;
  LibraryFile& operator=(const LibraryFile&) = delete;

  /// What it says to the linker: DT_NEEDED, the names of the libraries that it was linked with.
  [[nodiscard]] std::vector<std::string> Texts(std::int64_t tag) const {
    std::vector<std::string> found;
    for (const Segment& segment : Segments()) {
      if (segment.p_type != PT_DYNAMIC) continue;
      std::size_t texts = 0;
      std::vector<std::size_t> places;
      for (const auto& entry : All<ElfW(Dyn)>(segment.p_offset, segment.p_filesz)) {
        if (entry.d_tag == DT_STRTAB) texts = PlaceOf(entry.d_un.d_ptr);
        if (entry.d_tag == tag) places.push_back(entry.d_un.d_val);
      }
      for (const std::size_t place : places) {
        const auto text = bytes_.substr(std::min(texts + place, bytes_.size()));
        found.emplace_back(text.substr(0, text.find('\0')));
      }
    }
    return found;
  }

  /// Whether it is what is in memory. Only what nobody writes to is compared: code, constants, the linker's mark.
  [[nodiscard]] bool IsLoadedAs(const dl_phdr_info& loaded) const {
    for (const Segment& segment : std::span(loaded.dlpi_phdr, loaded.dlpi_phnum)) {
      if (segment.p_type != PT_LOAD || (segment.p_flags & PF_W) != 0) continue;
      const auto there = All<char>(segment.p_offset, segment.p_filesz);
      const auto* const in_memory = reinterpret_cast<const char*>(loaded.dlpi_addr + segment.p_vaddr);
      if (there.size() != segment.p_filesz || !IsSame(there, in_memory)) return false;
    }
    return true;
  }

 private:
  template <typename T>
  [[nodiscard]] std::span<const T> All(std::size_t place, std::size_t size) const {
    if (place > bytes_.size() || size > bytes_.size() - place || place % alignof(T) != 0) return {};
    return {reinterpret_cast<const T*>(bytes_.data() + place), size / sizeof(T)};
  }
  [[nodiscard]] std::span<const Segment> Segments() const {
    const auto head = All<ElfW(Ehdr)>(0, sizeof(ElfW(Ehdr)));
    if (head.empty() || std::memcmp(head[0].e_ident, ELFMAG, SELFMAG) != 0) return {};
    return All<Segment>(head[0].e_phoff, head[0].e_phnum * sizeof(Segment));
  }
  // In the file, of what is at `address` in memory.
  [[nodiscard]] std::size_t PlaceOf(std::size_t address) const {
    for (const Segment& segment : Segments()) {
      if (segment.p_type == PT_LOAD && address >= segment.p_vaddr && address - segment.p_vaddr < segment.p_filesz) {
        return segment.p_offset + (address - segment.p_vaddr);
      }
    }
    return bytes_.size();
  }

  std::string_view bytes_;
};

// The library that others name so, if it is in memory.
std::optional<dl_phdr_info> FindLoaded(std::string_view name) {
  struct Search {
    std::string_view name;
    std::optional<dl_phdr_info> found;
  } search{name, {}};
  dl_iterate_phdr(
      [](dl_phdr_info* info, std::size_t, void* at) {
        auto& wanted = *static_cast<Search*>(at);
        const std::string_view path = info->dlpi_name;
        if (path.substr(path.rfind('/') + 1) != wanted.name) return 0;
        wanted.found = *info;
        return 1;
      },
      &search);
  return search.found;
}

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

// Where the linker looks for what it needs, but for the system's own folders, whose files are put there whole.
std::vector<fs::path> FoldersOf(const LibraryFile& library, const fs::path& path) {
  constexpr std::array<std::string_view, 2> kOrigins{"$ORIGIN", "${ORIGIN}"};
  std::vector<std::string> texts = library.Texts(DT_RPATH);
  if (const char* const variable = std::getenv("LD_LIBRARY_PATH")) texts.emplace_back(variable);
  for (std::string& each : library.Texts(DT_RUNPATH)) texts.push_back(std::move(each));
  std::vector<fs::path> folders;
  for (const std::string& text : texts) {
    for (const std::string_view part : PartsBetween(":", text)) {
      std::string folder(part);
      for (const std::string_view origin : kOrigins) {
        const std::size_t place = folder.find(origin);
        if (place != std::string::npos) folder.replace(place, origin.size(), path.parent_path().string());
      }
      folders.emplace_back(folder);
    }
  }
  return folders;
}

Result<void> CheckOne(const fs::path& path) {
  std::error_code failed;
  const std::uint64_t size = fs::file_size(path, failed);
  std::ifstream file(path, std::ios::binary);
  if (failed || !file) return Error{.message = "it cannot be read"};
  const Error cut{.message = "it is cut short, or has not been written to its end yet",
                  .hint = "copy it under another name, and rename it when it is whole, as 'install' does"};
  char begin[SELFMAG] = {};
  file.read(begin, SELFMAG);
  if (std::memcmp(begin, ELFMAG, static_cast<std::size_t>(file.gcount())) != 0)
    return Error{.message = "it is no ELF file"};
  const auto head = ReadAt<ElfW(Ehdr)>(file, 0, 1);
  if (head.empty()) return cut;
  constexpr unsigned char kOwnClass = sizeof(void*) == 8 ? ELFCLASS64 : ELFCLASS32;
  if (head[0].e_ident[EI_CLASS] != kOwnClass)
    return {};  // of another kind of machine: the linker looks no further, and says so
  const auto segments = ReadAt<Segment>(file, head[0].e_phoff, head[0].e_phnum);
  const auto is_there = [size](const auto& each) {
    return each.p_offset <= size && each.p_filesz <= size - each.p_offset;
  };
  if (segments.empty() || !std::ranges::all_of(segments, is_there)) return cut;
  // Linkers write these last, at the end; a library may do without any.
  const auto sections = ReadAt<ElfW(Shdr)>(file, head[0].e_shoff, head[0].e_shnum);
  if (sections.size() != head[0].e_shnum) return cut;
  const std::size_t names = head[0].e_shstrndx;
  if (names != SHN_UNDEF && names < sections.size() && sections[names].sh_type != SHT_STRTAB) return cut;
  return {};
}

}  // namespace

AbiDifference FindAbiDifference(std::string_view plugin, std::string_view core) {
  AbiDifference difference;
  for (const auto& kind : kKinds) Compare(FlagIn(kind, plugin), FlagIn(kind, core), difference);
  // Another compiler comes first: its flags may be called otherwise.
  if (!difference.why.empty() && WithoutFlags(plugin) == WithoutFlags(core)) return difference;
  return {.why = "it was built with '" + std::string(plugin) + "', this core with '" + std::string(core) + "'",
          .cure = "rebuild the plugin with the compiler of the core"};
}

Result<void> CheckIsWhole(const fs::path& file) {
  std::vector<fs::path> paths{file};
  std::set<std::string> seen;
  while (!paths.empty()) {
    const fs::path path = std::move(paths.back());
    paths.pop_back();
    if (auto whole = CheckOne(path); !whole) {
      Error error = whole.error();
      if (path != file) error.message = path.string() + ", which it needs, cannot be loaded: " + error.message;
      return error;
    }
    const LibraryFile library(path);
    const std::vector<fs::path> folders = FoldersOf(library, path);
    for (const std::string& name : library.Texts(DT_NEEDED)) {
      if (FindLoaded(name) || !seen.insert(name).second) continue;
      const auto folder =
          std::ranges::find_if(folders, [&](const fs::path& each) { return access((each / name).c_str(), F_OK) == 0; });
      if (folder != folders.end()) paths.push_back(*folder / name);
    }
  }
  return {};
}

std::optional<fs::path> FindOutdatedDependency(const fs::path& file) {
  std::vector<std::string> names = LibraryFile(file).Texts(DT_NEEDED);
  std::set<std::string> seen;
  while (!names.empty()) {
    const std::string name = std::move(names.back());
    names.pop_back();
    const auto loaded = FindLoaded(name);
    if (!loaded || !seen.insert(name).second) continue;
    const fs::path path = loaded->dlpi_name;
    const LibraryFile library(path);
    if (!library.IsLoadedAs(*loaded)) return path;
    for (std::string& each : library.Texts(DT_NEEDED)) names.push_back(std::move(each));
  }
  return {};
}

}  // namespace runnel
