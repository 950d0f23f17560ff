#include <utility>
#include <vector>

#include "core/types/type_info.h"
#include "plugins/inspector/internal/viewer_session.h"
#include "plugins/values/json_values.h"
#include "plugins/values/value_bytes.h"

namespace runnel::internal {

namespace {

constexpr std::size_t kLongestText = 2'000;
constexpr std::size_t kLargestValue = 4'000'000;  // bytes
constexpr std::size_t kLargestImage = 16'000'000;

}  // namespace

bool ViewerSession::AppendValue(Watch& watch, const void* value, Time time, std::string& json) {
  const TypeInfo& type = watch.port.type();
  if (watch.wants_image && type.semantic_tag() == "image") {
    if (watch.pictured != &type) {
      std::vector<FoxgloveChannel> channels = ChannelsFor(type, watch.port.path(), {});
      watch.picture.reset();
      if (channels.size() > 1) watch.picture = std::move(channels.back());
      watch.pictured = &type;
    }
    if (watch.picture && BytesOf(type, value) <= kLargestImage) {
      watch.picture->append(value, time, json);
      return true;
    }
  }
  return AppendJson(type, value, json, {watch.elements, kLongestText, kLargestValue});
}

}  // namespace runnel::internal
