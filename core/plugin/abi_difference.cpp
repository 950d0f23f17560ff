#include "core/plugin/abi_difference.h"

#include <algorithm>
#include <array>
#include <vector>

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

std::vector<std::string_view> Words(std::string_view text) {
  std::vector<std::string_view> words;
  while (!text.empty()) {
    const std::size_t end = std::min(text.find(' '), text.size());
    if (end > 0) words.push_back(text.substr(0, end));
    text.remove_prefix(std::min(end + 1, text.size()));
  }
  return words;
}

const Flag* FlagIn(const std::array<Flag, 2>& kind, std::string_view fingerprint) {
  const std::vector<std::string_view> words = Words(fingerprint);
  const auto found = std::ranges::find_if(kind, [&](const Flag& flag) {
    return !flag.word.empty() && std::ranges::count(words, flag.word) > 0;
  });
  return found == kind.end() ? nullptr : &*found;
}

std::string WithoutFlags(std::string_view fingerprint) {
  std::string rest;
  for (const std::string_view word : Words(fingerprint)) {
    const bool is_flag = std::ranges::any_of(kKinds, [&](const auto& kind) {
      return std::ranges::count(kind, word, &Flag::word) > 0;
    });
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

}  // namespace

AbiDifference FindAbiDifference(std::string_view plugin, std::string_view core) {
  AbiDifference difference;
  for (const auto& kind : kKinds) Compare(FlagIn(kind, plugin), FlagIn(kind, core), difference);
  // Another compiler comes first: its flags may be called otherwise.
  if (!difference.why.empty() && WithoutFlags(plugin) == WithoutFlags(core)) return difference;
  return {.why = "it was built with '" + std::string(plugin) + "', this core with '" + std::string(core) + "'",
          .cure = "rebuild the plugin with the compiler of the core"};
}

}  // namespace runnel
