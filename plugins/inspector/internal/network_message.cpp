#include <mutex>

#include "plugins/command_service/extension_texts.h"
#include "plugins/inspector/internal/viewer_session.h"

namespace runnel::internal {

namespace {

constexpr auto kNetwork = std::chrono::milliseconds(500);
constexpr auto kLookAgain = std::chrono::milliseconds(5);

}  // namespace

// Of applications without a network nothing.
void ViewerSession::SendNetwork(SteadyTime now) {
  network_due_ = now + kNetwork;
  if (structure_ == 0 || IsSlow()) return;
  Runtime& runtime = inspection_.application().runtime;
  std::string picture;
  {
    const std::unique_lock lock(runtime.structure_mutex(), std::try_to_lock);
    if (!lock) {
      network_due_ = now + kLookAgain;
      return;
    }
    const ExtensionTexts::Text* const text = ExtensionTexts::Find(runtime, "network_picture");
    if (text == nullptr) return;
    std::shared_ptr<void> asking;
    const auto told = (*text)("", asking);
    if (!told || !*told) return;
    picture = **told;
  }
  if (picture == network_) return;
  if (client_.SendText("{\"op\":\"network\"," + picture.substr(1))) network_ = std::move(picture);
}

}  // namespace runnel::internal
