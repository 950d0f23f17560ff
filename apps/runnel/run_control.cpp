#include "apps/runnel/run_control.h"

namespace runnel::program {

void RunControl::AddHooks(Application& application, ServiceHooks& hooks) {
  hooks.quit = [this, &application]() -> Result<std::string> {
    is_asked_ = true;
    application.RequestStop();
    return std::string("the run ends");
  };
  hooks.restart = [this, &application]() -> Result<std::string> {
    if (auto good = check_(); !good) return good.error();
    shall_restart_ = true;
    is_asked_ = true;
    application.RequestStop();
    return std::string("runs again from its file");
  };
}

}  // namespace runnel::program
