#pragma once

#include <deque>
#include <map>
#include <memory>
#include <string>
#include <vector>

#include "plugins/genom_description/component.h"
#include "plugins/genom_description/scopes.h"
#include "plugins/genom_text/preprocessor.h"

namespace runnel::genom {

/// All that a description says: types, interfaces, components. Owns what its pointers lead to.
///
/// Threads: not thread-safe; once read it does not change.
class Description {
 public:
  explicit Description(Diagnostics& diagnostics) : problems(diagnostics), scopes(problems) {}
  Description(const Description&) = delete;
  Description& operator=(const Description&) = delete;

  Problems problems;
  Scopes scopes;
  std::deque<Component> components = {};  ///< and interfaces, in order
  std::deque<Task> tasks = {};
  std::deque<Service> services = {};
  std::deque<Port> ports = {};
  std::deque<Remote> remotes = {};
  std::deque<Codel> codels = {};
  std::map<std::string, std::map<const Type*, std::string>> masquerades = {};  ///< by template
  std::string notice = {};  ///< for the top of what is made from it

  [[nodiscard]] Component* FindComponent(std::string_view name);
};

/// Reads files as one description, in order. What is wrong is in the diagnostics; the description is complete only if
/// these are ok. Never throws, however the files look.
[[nodiscard]] std::unique_ptr<Description> ReadDescription(const std::vector<std::string>& files,
                                                           const PreprocessorOptions& options,
                                                           Diagnostics& diagnostics);
/// The same from a text; `name` stands in messages, and says where included files are looked for.
[[nodiscard]] std::unique_ptr<Description> ReadDescriptionText(const std::string& text, const std::string& name,
                                                               const PreprocessorOptions& options,
                                                               Diagnostics& diagnostics);

/// The whole description as JSON: types with their layout, interfaces, components with ports, tasks, services, codels and
/// what these exclude. What each field is, says the README.
[[nodiscard]] std::string DescriptionJson(const Description& description);

}  // namespace runnel::genom
