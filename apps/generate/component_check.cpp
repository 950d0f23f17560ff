#include "apps/generate/component_check.h"

#include <algorithm>

#include "core/base/number_text.h"
#include "plugins/genom_templates/template_run.h"
#include "plugins/model_checker/spin.h"

namespace runnel {

namespace {

constexpr std::size_t kLastSteps = 12;  // of a long run, which nobody reads from its beginning

const SpinSearch kSafety{.options = {"-bfs"}, .limit = 120};
const SpinSearch kEnds{.definitions = {"-DENDS"}, .options = {"-a", "-f", "-m2000000"}, .limit = 240};
// Not all, but if there is something, it is told in few steps.
const SpinSearch kShortEnds{.definitions = {"-DENDS"}, .options = {"-a", "-f", "-m200"}, .limit = 20};

std::string Take(std::string& text, char until) {
  const std::size_t end = std::min(text.find(until), text.size());
  std::string taken = text.substr(0, end);
  text.erase(0, std::min(end + 1, text.size()));
  return taken;
}

// "fault FILE<tab>LINE<tab>COLUMN<tab>MESSAGE"
Error ReadFault(std::string line) {
  Error error;
  error.position.file = Take(line, '\t');
  error.position.line = NumberIn<int>(Take(line, '\t')).value_or(0);
  error.position.column = NumberIn<int>(Take(line, '\t')).value_or(0);
  error.message = line;
  return error;
}

/// What happens, step by step, and the last fault that the model names.
Error Tell(const SpinAnswer& answer) {
  Error error;
  std::vector<std::string> steps;
  std::size_t repeats_from = 0;
  for (std::size_t i = 0; i < answer.run.size(); ++i) {
    if (i == answer.repeats_from) repeats_from = steps.size();
    std::string line = answer.run[i];
    const std::string what = Take(line, ' ');
    if (what == "fault") error = ReadFault(line);
    if (what == "step") steps.push_back(line);
    if (what == "and" && !steps.empty()) steps.back() += " " + line;
  }
  if (answer.repeats_from >= answer.run.size()) repeats_from = steps.size();
  std::string text;
  const std::size_t first = repeats_from > kLastSteps ? repeats_from - kLastSteps : 0;
  if (first > 0) text = "\n    …";
  for (std::size_t i = first; i < steps.size(); ++i) {
    if (i == repeats_from) text += "\n  over and over:";
    text += "\n    " + steps[i];
  }
  error.message += ":" + text;
  if (repeats_from == steps.size()) error.message += "\n    and nothing more";
  return error;
}

// True if what must hold holds, or nobody knows.
bool Check(const std::string& model, const SpinSearch& search, const std::string& name, Diagnostics& diagnostics) {
  auto answer = RunSpin(model, search);
  if (!answer) {
    diagnostics.AddWarning(
        {.message = "component " + name + " " + answer.error().message, .hint = answer.error().hint});
    return true;
  }
  if (answer->holds) return true;
  if (&search == &kEnds) {
    if (auto shorter = RunSpin(model, kShortEnds); shorter && !shorter->holds) answer = std::move(shorter);
  }
  diagnostics.Add(Tell(*answer));
  return false;
}

}  // namespace

void CheckBySpin(const std::string& model, Diagnostics& diagnostics) {
  const auto folder = genom::FindTemplate("promela");
  if (!folder) return diagnostics.Add(folder.error());
  const auto made = genom::RunTemplate(*folder, model, {});
  if (!made) return diagnostics.Add(made.error());
  for (const genom::GeneratedFile& file : made->files) {
    const std::string name = file.path.substr(0, file.path.rfind('.'));
    // What conflicts or stands still is told first; the rest would say it again.
    if (Check(file.text, kSafety, name, diagnostics)) (void)Check(file.text, kEnds, name, diagnostics);
  }
}

}  // namespace runnel
