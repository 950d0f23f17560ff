#include "plugins/ros_messages/quality.h"

#include <algorithm>

#include "core/base/nearest_name.h"

namespace runnel {

namespace {

struct Profile {
  const char* name;
  Quality quality;
};

constexpr Quality Keep(std::uint32_t depth) {
  Quality quality;
  quality.depth = depth;
  return quality;
}
constexpr Quality BestEffort(std::uint32_t depth) {
  Quality quality = Keep(depth);
  quality.is_reliable = false;
  return quality;
}
constexpr Quality Latched(std::uint32_t depth, Duration lifespan = Duration::max()) {
  Quality quality = Keep(depth);
  quality.is_transient_local = true;
  quality.lifespan = lifespan;
  return quality;
}
constexpr Quality All() {
  Quality quality = Latched(1);
  quality.keeps_all = true;
  return quality;
}

constexpr Profile kProfiles[] = {
    {"default", Keep(10)},
    {"services", Keep(10)},
    {"sensor", BestEffort(5)},
    {"parameters", Keep(1000)},
    {"parameter_events", Keep(1000)},
    {"rosout", Latched(1000, std::chrono::seconds(10))},
    {"latched", Latched(1)},
    {"clock", BestEffort(1)},
    {"discovery_writer", Latched(1)},
    {"discovery_reader", All()},
    {"newest", Keep(1)},
    {"each", Keep(10)},
};

}  // namespace

Result<Quality> FindQuality(std::string_view name) {
  const auto found = std::ranges::find(kProfiles, name, &Profile::name);
  if (found != std::end(kProfiles)) return found->quality;
  return Error{.message = "there is no quality of service '" + std::string(name) + "'",
               .hint = NearestNameHint(name, NamesOf(kProfiles, &Profile::name))};
}

std::string WhyNoMatch(const Quality& writer, const Quality& reader) {
  if (reader.is_reliable && !writer.is_reliable) {
    return "the reader asks for reliable delivery, and the writer offers best effort";
  }
  if (reader.is_transient_local && !writer.is_transient_local) {
    return "the reader asks for values of before it came (transient local), and the writer keeps none (volatile)";
  }
  return "";
}

}  // namespace runnel
