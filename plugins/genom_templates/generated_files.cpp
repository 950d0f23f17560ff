#include "plugins/genom_templates/generated_files.h"

#include "core/base/replace_file.h"
#include "plugins/genom_templates/file_text.h"

namespace runnel::genom {

namespace {

namespace fs = std::filesystem;
using What = WrittenFile::What;

constexpr const char* kKeptFolder = ".generated";

bool LeadsOut(const fs::path& path) {
  const fs::path normal = path.lexically_normal();
  return normal.empty() || normal.is_absolute() || *normal.begin() == ".." || *normal.begin() == kKeptFolder;
}

struct Plan {
  WrittenFile written;
  std::string text;
};

// What becomes of the file, without writing it.
Plan PlanFor(const fs::path& folder, const GeneratedFile& file, bool overwrites, Diagnostics& diagnostics) {
  Plan plan{{.path = file.path}, file.text};
  if (LeadsOut(file.path)) {
    diagnostics.Add({.message = "a template cannot make '" + file.path + "'", .hint = "its files are within one folder"});
    return plan;
  }
  const auto before = TextOf(folder / file.path);
  if (!before) return plan;
  if (*before == file.text) {
    plan.written.what = What::kSame;
    return plan;
  }
  plan.written.what = What::kReplaced;
  if (!file.is_kept || overwrites) return plan;
  const auto base = TextOf(folder / kKeptFolder / file.path);
  if (!base) {
    diagnostics.Add({.message = "this file is there already, and was made by nothing that is known here",
                     .position = {(folder / file.path).string()},
                     .hint = "move it away, or have it overwritten"});
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

}  // namespace

std::vector<WrittenFile> WriteFiles(const fs::path& folder, const std::vector<GeneratedFile>& files, bool overwrites,
                                    Diagnostics& diagnostics) {
  std::vector<Plan> plans;
  for (const GeneratedFile& each : files) plans.push_back(PlanFor(folder, each, overwrites, diagnostics));
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

}  // namespace runnel::genom
