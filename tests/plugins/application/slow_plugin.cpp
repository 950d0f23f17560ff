// A library that takes its time to be opened, as from a slow disk: as long as there is a file of this name.

#include <chrono>
#include <cstdlib>
#include <filesystem>
#include <fstream>
#include <string>
#include <thread>

#include "core/module/module.h"
#include "core/plugin/plugin_entry.h"

namespace runnel::test {
namespace {

[[maybe_unused]] const bool kIsOpen = [] {
  const char* const hold = std::getenv("RUNNEL_TEST_HOLD");
  if (hold == nullptr) return true;
  std::ofstream(std::string(hold) + ".begun") << "is being opened";
  for (int i = 0; i < 60'000 && std::filesystem::exists(hold); ++i)
    std::this_thread::sleep_for(std::chrono::milliseconds(1));
  return true;
}();

class Late final : public Module {
 public:
  using Module::Module;

 private:
  void Update() override {}
};

}  // namespace
}  // namespace runnel::test

RUNNEL_PLUGIN(slow, registry) { registry.Add<runnel::test::Late>("slow/late", "comes late"); }
