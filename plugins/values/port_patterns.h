#pragma once

#include <string>
#include <string_view>
#include <vector>

#include "core/base/result.h"

namespace runnel {

/// Which ports somebody means: patterns of paths, of which one must fit, and, behind a '!', patterns of
/// those that are not meant.
///
///     /robot/pose        that port; the application's name and the port's group may be left out
///     */pose             a * stands for a part of a path, also within a name: */p*
///     /robot/**          ** for any number of parts: all below
///     !**/scan           but not that
///
/// Several may stand in one text, with commas between. A pattern without a '/' in front fits at any depth. Without a pattern, all ports are meant.
/// Threads: never changed once made; any.
class PortPatterns {
 public:
  /// Errors: an empty pattern, nothing but exclusions' marks.
  static Result<PortPatterns> Make(const std::vector<std::string>& patterns);

  /// `path` as the tree has it: "/application/group/module/output/port".
  [[nodiscard]] bool Fit(std::string_view path) const;
  /// Those, but for exclusions, that name one port: without a *.
  [[nodiscard]] std::vector<std::string> Names() const;
  /// Whether one of those means the port, not only a *.
  [[nodiscard]] bool Name(std::string_view path) const;
  [[nodiscard]] const std::vector<std::string>& texts() const noexcept { return texts_; }

 private:
  using Parts = std::vector<std::string>;

  [[nodiscard]] static bool FitOne(const Parts& pattern, std::string_view path);

  std::vector<std::string> texts_;
  std::vector<Parts> wanted_;
  std::vector<Parts> excluded_;
};

/// The names in a path.
[[nodiscard]] std::vector<std::string> PartsOf(std::string_view path);
/// The path by which people know a port: without the port's group.
[[nodiscard]] std::string PlainPortPath(std::string_view path);
/// The same without the application's name, which is the first.
[[nodiscard]] std::string ShortPortPath(std::string_view path);

}  // namespace runnel
