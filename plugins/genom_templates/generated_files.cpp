#include "plugins/genom_templates/generated_files.h"

#include <algorithm>
#include <cstdint>
#include <string_view>
#include <vector>

#include "core/base/replace_file.h"
#include "plugins/genom_text/file_text.h"

namespace runnel::genom {

namespace {

namespace fs = std::filesystem;
using What = WrittenFile::What;

constexpr const char* kKeptFolder = ".generated";

struct Plan {
  WrittenFile written;
  std::string text;
};

// What becomes of the file, without writing it.
Plan PlanFor(const fs::path& folder, const GeneratedFile& file, WhatIsThere what_is_there, Diagnostics& diagnostics) {
  Plan plan{{.path = file.path}, file.text};
  const fs::path path = fs::path(file.path).lexically_normal();
  if (path.empty() || path.is_absolute() || *path.begin() == ".." || *path.begin() == kKeptFolder) {
    diagnostics.Add(
        {.message = "a template cannot make '" + file.path + "'", .hint = "its files are within one folder"});
    return plan;
  }
  const auto before = TextOf(folder / file.path);
  if (!before) return plan;
  if (*before == file.text) {
    plan.written.what = What::kSame;
    return plan;
  }
  plan.written.what = What::kReplaced;
  if (!file.is_kept || what_is_there == WhatIsThere::kIsOverwritten) return plan;
  const auto base = TextOf(folder / kKeptFolder / file.path);
  if (!base && what_is_there == WhatIsThere::kIsAdopted) {
    plan.written.what = What::kSame;
    return plan;
  }
  if (!base) {
    diagnostics.Add({.message = "this file is there already, and was made by nothing that is known here",
                     .position = {(folder / file.path).string()},
                     .hint = "move it away, or have it adopted or overwritten"});
    return plan;
  }
  if (*base == *before) return plan;  // its user has changed nothing
  Merged merged = Merge(*base, *before, file.text);
  plan.text = std::move(merged.text);
  plan.written.conflicts = merged.conflicts;
  plan.written.what = merged.conflicts > 0 ? What::kConflict : plan.text == *before ? What::kSame : What::kMerged;
  return plan;
}

bool WriteOne(const fs::path& file, const std::string& text, Diagnostics& diagnostics) {
  std::error_code error;
  fs::create_directories(file.parent_path(), error);
  const auto written = ReplaceFile(file, text);
  if (!written) diagnostics.Add(written.error());
  return written.has_value();
}

using Lines = std::vector<std::string_view>;
constexpr std::size_t kNone = static_cast<std::size_t>(-1);

Lines LinesOf(std::string_view text) {
  Lines lines;
  while (!text.empty()) {
    const std::size_t end = std::min(text.find('\n'), text.size() - 1) + 1;
    lines.push_back(text.substr(0, end));
    text.remove_prefix(end);
  }
  return lines;
}

// For each line of `base`, where it is in `other`, by a longest common subsequence; kNone where it is not.
std::vector<std::size_t> Matches(const Lines& base, const Lines& other) {
  const std::size_t width = other.size() + 1;
  std::vector<std::uint32_t> longest((base.size() + 1) * width, 0);
  for (std::size_t i = base.size(); i-- > 0;) {
    for (std::size_t j = other.size(); j-- > 0;) {
      longest[i * width + j] = base[i] == other[j] ? longest[(i + 1) * width + j + 1] + 1
                                                   : std::max(longest[(i + 1) * width + j], longest[i * width + j + 1]);
    }
  }
  std::vector<std::size_t> matches(base.size(), kNone);
  for (std::size_t i = 0, j = 0; i < base.size() && j < other.size();) {
    if (base[i] == other[j]) {
      matches[i++] = j++;
    } else if (longest[(i + 1) * width + j] >= longest[i * width + j + 1]) {
      ++i;
    } else {
      ++j;
    }
  }
  return matches;
}

Lines Part(const Lines& lines, std::size_t from, std::size_t to) {
  return {lines.begin() + static_cast<std::ptrdiff_t>(from), lines.begin() + static_cast<std::ptrdiff_t>(to)};
}

void Append(std::string& text, const Lines& lines) {
  for (const std::string_view each : lines) text += each;
}

void AppendWhole(std::string& text, const Lines& lines) {
  Append(text, lines);
  if (!lines.empty() && !text.ends_with('\n')) text += '\n';
}

void AppendConflict(Merged& merged, const Lines& mine, const Lines& made) {
  ++merged.conflicts;
  merged.text += "<<<<<<< yours\n";
  AppendWhole(merged.text, mine);
  merged.text += "=======\n";
  AppendWhole(merged.text, made);
  merged.text += ">>>>>>> template\n";
}

}  // namespace

std::vector<WrittenFile> WriteFiles(const fs::path& folder, const std::vector<GeneratedFile>& files,
                                    WhatIsThere what_is_there, Diagnostics& diagnostics) {
  std::vector<Plan> plans;
  for (const GeneratedFile& each : files) plans.push_back(PlanFor(folder, each, what_is_there, diagnostics));
  std::vector<WrittenFile> written;
  if (!diagnostics.ok()) return written;
  for (std::size_t i = 0; i < files.size(); ++i) {
    const bool is_same = plans[i].written.what == What::kSame;
    if (!is_same && !WriteOne(folder / files[i].path, plans[i].text, diagnostics)) break;
    // Last, so that a file which could not be written is merged with the old one again.
    if (files[i].is_kept && TextOf(folder / kKeptFolder / files[i].path) != files[i].text &&
        !WriteOne(folder / kKeptFolder / files[i].path, files[i].text, diagnostics)) {
      break;
    }
    written.push_back(plans[i].written);
  }
  return written;
}

Merged Merge(const std::string& base_text, const std::string& mine_text, const std::string& made_text) {
  const Lines base = LinesOf(base_text);
  const Lines mine = LinesOf(mine_text);
  const Lines made = LinesOf(made_text);
  const auto in_mine = Matches(base, mine);
  const auto in_made = Matches(base, made);
  Merged merged;
  std::size_t i = 0, a = 0, b = 0;
  while (i < base.size() || a < mine.size() || b < made.size()) {
    if (i < base.size() && in_mine[i] == a && in_made[i] == b) {
      merged.text += base[i];
      ++i, ++a, ++b;
      continue;
    }
    // Up to the next line that all three have.
    std::size_t next = i;
    while (next < base.size() && (in_mine[next] == kNone || in_made[next] == kNone)) ++next;
    const bool is_end = next == base.size();
    const std::size_t a_end = is_end ? mine.size() : in_mine[next];
    const std::size_t b_end = is_end ? made.size() : in_made[next];
    const Lines before = Part(base, i, next);
    const Lines of_mine = Part(mine, a, a_end);
    const Lines of_made = Part(made, b, b_end);
    if (of_mine == before || of_mine == of_made) {
      Append(merged.text, of_made);
    } else if (of_made == before) {
      Append(merged.text, of_mine);
    } else {
      AppendConflict(merged, of_mine, of_made);
    }
    i = next, a = a_end, b = b_end;
  }
  return merged;
}

}  // namespace runnel::genom
