#pragma once

#include <cstdint>
#include <filesystem>
#include <memory>
#include <string>

#include "plugins/application_files/application_builder.h"

namespace runnel::testing {

/// Tries what text whatever does as an application file, and says what is wrong with that: an
/// exception, a failure without an error, an error without a place, anything left of an application
/// that could not be built, one that is another after it has been saved and loaded. Crashes and
/// endless loops are left to those who watch it.
class FileTrial {
 public:
  /// Writes the files that others use into `folder`, among them those of the corpus.
  FileTrial(std::filesystem::path folder, const std::filesystem::path& corpus);
  ~FileTrial();

  /// "" if nothing is wrong. `number` decides how it is built: checked, constructed or made ready,
  /// from memory or from a file, and whether it is saved.
  [[nodiscard]] std::string Try(const std::string& text, std::uint64_t number);

  struct Counts {
    std::uint64_t unreadable = 0;  ///< no well-formed XML
    std::uint64_t refused = 0;     ///< no application
    std::uint64_t built = 0;
    std::uint64_t saved = 0;
  };
  [[nodiscard]] const Counts& counts() const { return counts_; }

 private:
  struct World;
  std::string TryAt(World& world, const std::string& text, std::uint64_t number);
  std::string TryFile(World& world, const std::string& text, std::uint64_t number);
  std::string TryDocument(World& world, const std::string& text, std::uint64_t number);
  std::string TryAsPart(World& world, const std::string& text);
  std::string Judge(World& world, const BuildOutcome& outcome, const std::string& before, BuildMode mode);
  std::string JudgePlaces(const Diagnostics& diagnostics, const std::string& text) const;
  std::string TrySaving(World& world, FrameworkElement& application, const std::string* text);
  std::string TryAgain(const std::string& saved, const std::string& structure);

  const std::filesystem::path folder_;
  std::unique_ptr<World> world_;
  std::unique_ptr<World> second_;  // where what was saved is loaded again
  Counts counts_;
};

}  // namespace runnel::testing
