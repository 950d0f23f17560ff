#include <algorithm>
#include <filesystem>
#include <fstream>
#include <iostream>

#include <unistd.h>

#include "apps/runnel/commands.h"
#include "apps/runnel/output.h"
#include "core/base/program_output.h"
#include "core/base/replace_file.h"
#include "plugins/application/application_description.h"
#include "plugins/application/dot_text.h"

namespace runnel::program {

namespace {

namespace fs = std::filesystem;

const std::vector<std::string> kKinds{"dot", "pdf", "png", "svg"};

// What is written beside the picture until it is whole.
class TextBeside {
 public:
  TextBeside(const fs::path& picture, const std::string& text)
      : path_(picture.string() + "." + std::to_string(getpid()) + ".dot") {
    std::ofstream(path_) << text;
  }
  ~TextBeside() {
    std::error_code ignored;
    fs::remove(path_, ignored);
  }
  TextBeside(const TextBeside&) = delete;
  TextBeside& operator=(const TextBeside&) = delete;
  [[nodiscard]] const std::string& path() const { return path_; }

 private:
  std::string path_;
};

Result<void> Draw(const std::string& text, const std::string& output, const std::string& kind) {
  if (kind == "dot") return ReplaceFile(output, text);
  const TextBeside beside(output, text);
  if (!fs::exists(beside.path())) {
    return Error{.message = "cannot be written", .position = {output}};
  }
  const auto ran = OutputOf({.words = {"dot", "-T" + kind, "-o", output, beside.path()}, .keeps_complaints = true});
  if (!ran) {
    return Error{.message = "the program 'dot' that lays out the picture is not here",
                 .hint = "install the package graphviz, or write the text for it with -o " +
                         fs::path(output).replace_extension(".dot").string()};
  }
  std::cerr << ran->text;
  if (ran->exit_code != 0) {
    return Error{.message = "'dot' ended with status " + std::to_string(ran->exit_code),
                 .position = {output}};
  }
  return {};
}

}  // namespace

ExitCode DrawGraph(const GraphArguments& arguments) {
  std::string kind = fs::path(arguments.output).extension().string();
  if (!kind.empty()) kind.erase(0, 1);
  if (std::find(kKinds.begin(), kKinds.end(), kind) == kKinds.end()) {
    return Fail({.message = "no picture can be written as '" + arguments.output + "'",
                 .hint = "its name ends in .svg, .png, .pdf or .dot"}, ExitCode::kBadInput);
  }
  ApplicationDescription description(arguments.application.Options());
  const bool is_right = description.Read(arguments.application.file);
  std::cerr << description.diagnostics().ToString();
  if (!is_right) return ExitCode::kBadInput;
  const auto drawn = Draw(DotText(*description.element()), arguments.output, kind);
  return drawn ? ExitCode::kDone : Fail(drawn.error());
}

}  // namespace runnel::program
