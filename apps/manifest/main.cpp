// The command `runnel manifest`: writes beside the library of a plugin what its modules look like. runnel_plugin()
// has it run after each build, so that nobody else has to make modules to know.

#include <filesystem>

#include "apps/program.h"
#include "core/base/files.h"
#include "core/element/runtime.h"
#include "core/plugin/plugin_manager.h"
#include "plugins/manifest/plugin_manifest.h"

namespace runnel {

namespace {

Result<PluginManifest> ManifestOf(const std::string& library) {
  auto build_id = BuildIdOf(library);
  if (!build_id) return build_id.error();
  PluginManager plugins;
  const auto file = std::filesystem::absolute(library);
  if (const auto loaded = plugins.Load(file.string()); !loaded) return loaded.error();
  PluginManifest manifest{.plugin = file.stem().string(), .build_id = std::move(*build_id), .modules = {}};
  Runtime runtime;
  for (const ModuleType* type : plugins.modules().All()) {
    if (auto module = DescribeByMaking(runtime, plugins.modules(), type->name)) {
      manifest.modules.push_back(std::move(*module));
    }
  }
  return manifest;
}

int WriteManifest(const std::string& library) {
  const auto manifest = ManifestOf(library);
  if (!manifest) return Fail(manifest.error());
  const auto written = ReplaceFile(ManifestFileOf(library), ManifestText(*manifest));
  return written ? exit_code::kDone : Fail(written.error(), exit_code::kRunFailed);
}

}  // namespace

}  // namespace runnel

int main(int count, char** words) {
  CLI::App program("Writes beside the library of a plugin what its modules look like, for those who do not load it.",
                   "runnel manifest");
  std::string library;
  program.add_option("library", library, "the plugin: planning.so; planning.manifest.xml is written beside it")
      ->required()
      ->type_name("FILE.so")
      ->check(CLI::ExistingFile);
  program.footer("Exit codes: 0 done, 1 the file could not be written, 2 bad input.");
  return runnel::RunProgram(program, count, words, [&] { return runnel::WriteManifest(library); });
}
