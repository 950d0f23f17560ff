#pragma once

#include <filesystem>
#include <string>
#include <vector>

#include "core/base/error.h"
#include "core/base/result.h"

namespace runnel::genom {

/// A file that a template has made.
struct GeneratedFile {
  std::string path = {};  ///< relative to the folder that is written to
  std::string text = {};
  bool is_kept = false;  ///< belongs to the user, who changes it: making it anew keeps that
};

struct WrittenFile {
  enum class What { kNew, kSame, kReplaced, kMerged, kConflict };
  std::string path = {};
  What what = What::kNew;
  int conflicts = 0;
};

/// What becomes of files that belong to the user.
enum class WhatIsThere {
  kIsMerged,  ///< with what the template makes now
  kIsAdopted,  ///< the same; what was not made here stays as it is, and counts as a change of what the template makes now
  kIsOverwritten
};

/// Writes files into a folder. One that is the same is left alone, with its time. Of one that is kept, the text as it was
/// made lies in the folder `.generated`: what its user has changed since is merged with what the template now makes.
///
/// Errors, with nothing written: a kept file that was there before and of which nobody knows how it was made, unless
/// `what_is_there` says what becomes of it; a path that leads out of the folder. Errors while writing: that of the file; those before it are written.
[[nodiscard]] std::vector<WrittenFile> WriteFiles(const std::filesystem::path& folder,
                                                  const std::vector<GeneratedFile>& files, WhatIsThere what_is_there,
                                                  Diagnostics& diagnostics);

struct Merged {
  std::string text = {};
  int conflicts = 0;  ///< where both changed the same lines, both stand in the text between marks
};

/// What becomes of a text that was made as `base`, that its user changed to `mine`, and that is made anew as `made`: the
/// changes of both, line by line, the last with its end. By the program diff3, which each Debian has. Errors: it is not here.
[[nodiscard]] Result<Merged> Merge(const std::string& base, const std::string& mine, const std::string& made);

}  // namespace runnel::genom
