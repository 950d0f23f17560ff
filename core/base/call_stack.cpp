#include "core/base/call_stack.h"

#include <algorithm>
#include <cstdio>
#include <cstdlib>
#include <filesystem>
#include <iterator>
#include <map>
#include <memory>

#include <cxxabi.h>
#include <dlfcn.h>
#include <execinfo.h>
#include <link.h>
#include <unistd.h>

#include "core/base/program_output.h"

namespace runnel {

namespace {

// Where a call is, in the file that its code came from.
struct Place {
  std::string file;
  std::string offset;  // hexadecimal
  std::string symbol;  // "" if it is not exported
};

Place PlaceOf(const void* frame) {
  // Within the call, not behind it, where another line or function may begin.
  const void* const call = static_cast<const char*>(frame) - 1;
  Dl_info info{};
  link_map* loaded = nullptr;
  if (dladdr1(call, &info, reinterpret_cast<void**>(&loaded), RTLD_DL_LINKMAP) == 0) return {};
  std::array<char, 20> offset{};
  (void)std::snprintf(offset.data(), offset.size(), "0x%lx", reinterpret_cast<std::uintptr_t>(call) - loaded->l_addr);
  const bool is_program = loaded->l_name[0] == '\0';
  return {is_program ? "/proc/self/exe" : loaded->l_name, offset.data(),
          info.dli_sname != nullptr ? Demangled(info.dli_sname) : ""};
}

std::string TakeLine(std::string& text) {
  const std::size_t end = std::min(text.find('\n'), text.size());
  std::string line = text.substr(0, end);
  text.erase(0, end + 1);
  return line;
}

// "/src/build/../wanderer.cpp:26 (discriminator 2)" is "/src/wanderer.cpp:26".
std::string LineText(const std::string& line) {
  const std::string place = line.substr(0, line.find(" ("));
  return std::filesystem::path(place).lexically_normal().string();
}

// Of addr2line's two lines for a call: function, and file with line; "??" stands for what it does not know.
std::string TextOf(const Place& place, const std::string& function, const std::string& line) {
  std::string text = function.empty() || function == "??" ? place.symbol : function;
  const std::string file = place.file.substr(place.file.find_last_of('/') + 1);
  if (text.empty()) return file.empty() ? "?" : file + " + " + place.offset;
  const bool is_known = !line.empty() && !line.starts_with("??") && !line.ends_with(":?");
  return text + (is_known ? " at " + LineText(line) : " in " + file);
}

// Takes what addr2line says of one call: its address, and of each function that is inlined there two lines.
std::vector<std::string> TakeTexts(const Place& place, std::string& output) {
  (void)TakeLine(output);
  std::vector<std::string> texts;
  do {
    const std::string function = TakeLine(output);
    texts.push_back(TextOf(place, function, TakeLine(output)));
  } while (!output.empty() && !output.starts_with("0x"));
  return texts;
}

}  // namespace

CallStack CallStack::Take() noexcept {
  CallStack stack;
  const int depth = backtrace(stack.frames_.data(), static_cast<int>(kDeepest));
  stack.depth_ = static_cast<std::size_t>(std::max(depth, 0));
  return stack;
}

void CallStack::KeepBetween(const void* inner, const void* outer) noexcept {
  const auto end = frames_.begin() + static_cast<std::ptrdiff_t>(depth_);
  auto begin = std::find(frames_.begin(), end, inner);
  if (begin == end) begin = frames_.begin();
  auto last = std::find(begin, end, outer);
  // Before it stands where the outer function has called what is wanted.
  if (last != end && last != begin) --last;
  depth_ = static_cast<std::size_t>(std::move(begin, last, frames_.begin()) - frames_.begin());
  std::fill(frames_.begin() + static_cast<std::ptrdiff_t>(depth_), frames_.end(), nullptr);
}

bool operator==(const CallStack& a, const CallStack& b) noexcept { return std::ranges::equal(a.frames(), b.frames()); }

std::vector<std::string> CallStack::Texts() const {
  std::vector<Place> places;
  std::map<std::string, std::vector<std::size_t>> of_file;
  for (const void* const frame : frames()) {
    of_file[places.emplace_back(PlaceOf(frame)).file].push_back(places.size() - 1);
  }
  std::vector<std::vector<std::string>> texts(places.size());
  for (const auto& [file, calls] : of_file) {
    // The process that is asked is another one.
    const std::string program = "/proc/" + std::to_string(getpid()) + "/exe";
    std::vector<std::string> words{"addr2line", "-Cfiae", file == "/proc/self/exe" ? program : file};
    for (const std::size_t each : calls) words.push_back(places[each].offset);
    const Result<ProgramOutput> answer = file.empty() ? ProgramOutput{} : OutputOf({.words = std::move(words)});
    std::string output = answer ? answer->text : "";
    for (const std::size_t each : calls) texts[each] = TakeTexts(places[each], output);
  }
  std::vector<std::string> all;
  for (auto& each : texts) std::ranges::move(each, std::back_inserter(all));
  return all;
}

std::string Demangled(const char* name) {
  int status = 0;
  const std::unique_ptr<char, decltype(&std::free)> readable(abi::__cxa_demangle(name, nullptr, nullptr, &status),
                                                             &std::free);
  return readable ? readable.get() : name;
}

}  // namespace runnel
