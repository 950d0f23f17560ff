#include <algorithm>
#include <filesystem>
#include <iostream>

#include "apps/runnel/command_line.h"
#include "apps/runnel/output.h"
#include "core/base/files.h"
#include "core/base/program_output.h"
#include "plugins/application/application_description.h"
#include "plugins/application/dot_text.h"

namespace runnel::program {

namespace {

namespace fs = std::filesystem;

const std::vector<std::string> kKinds{"dot", "pdf", "png", "svg"};

Result<void> Draw(const std::string& text, const std::string& output, const std::string& kind) {
  if (kind == "dot") return ReplaceFile(output, text);
  const auto folder = TemporaryFolder::Make("graph");
  if (!folder) return folder.error();
  const std::string source = folder->path() / "graph.dot";
  if (auto written = ReplaceFile(source, text); !written) return written;
  const auto ran = OutputOf({.words = {"dot", "-T" + kind, "-o", output, source}, .keeps_complaints = true});
  if (!ran) {
    return Error{.message = "the program 'dot' that lays out the picture is not here",
                 .hint = "install the package graphviz, or write the text for it with -o " +
                         fs::path(output).replace_extension(".dot").string()};
  }
  std::cerr << ran->text;
  if (ran->exit_code != 0) {
    return Error{.message = "'dot' ended with status " + std::to_string(ran->exit_code), .position = {output}};
  }
  return {};
}

}  // namespace

ExitCode DrawGraph(const GraphArguments& arguments) {
  std::string kind = fs::path(arguments.output).extension().string();
  if (!kind.empty()) kind.erase(0, 1);
  if (std::find(kKinds.begin(), kKinds.end(), kind) == kKinds.end()) {
    return Fail({.message = "no picture can be written as '" + arguments.output + "'",
                 .hint = "its name ends in .svg, .png, .pdf or .dot"},
                ExitCode::kBadInput);
  }
  ApplicationDescription description(arguments.application.Options());
  const bool is_right = description.Read(arguments.application.file);
  std::cerr << description.diagnostics().ToString();
  if (!is_right) return ExitCode::kBadInput;
  const auto drawn = Draw(DotText(*description.element()), arguments.output, kind);
  return drawn ? ExitCode::kDone : Fail(drawn.error());
}

}  // namespace runnel::program
