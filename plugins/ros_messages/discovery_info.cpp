#include "plugins/ros_messages/discovery_info.h"

#include <algorithm>

#include "core/base/nearest_name.h"
#include "plugins/cdr_values/cdr_reader.h"
#include "plugins/cdr_values/cdr_writer.h"

namespace runnel {

namespace {

constexpr std::size_t kLongGid = 24, kHeader = CdrWriter::kHeader, kLongestName = 256;

std::size_t SizeOf(RosGidLayout layout) {
  return layout == RosGidLayout::kHumble ? kLongGid : RosGid().size();
}

void WriteGid(const RosGid& gid, RosGidLayout layout, CdrWriter& writer) {
  writer.PutPlain(gid.data(), 1, gid.size());
  for (std::size_t i = gid.size(); i < SizeOf(layout); ++i) writer.Put(std::uint8_t{0});
}

void WriteGids(const std::vector<RosGid>& gids, RosGidLayout layout, CdrWriter& writer) {
  writer.PutCount(gids.size());
  for (const RosGid& gid : gids) WriteGid(gid, layout, writer);
}

// In the long layout what is behind the sixteenth octet is 0; in the short one it is the count of nodes and, if there are
// any, the length of a name, which is never 0.
RosGidLayout LayoutOf(std::span<const std::byte> octets) {
  constexpr std::size_t kBegin = kHeader + RosGid().size(), kEnd = kHeader + kLongGid;
  if (octets.size() < kEnd + 4) return RosGidLayout::kIron;
  const auto behind = octets.subspan(kBegin, kEnd - kBegin);
  const bool is_long = std::ranges::all_of(behind, [](std::byte each) { return each == std::byte{0}; });
  return is_long ? RosGidLayout::kHumble : RosGidLayout::kIron;
}

/// Each function is false if the octets end.
class InfoReader {
 public:
  InfoReader(CdrReader& reader, RosGidLayout layout) : reader_(reader), layout_(layout) {}

  bool Read(RosParticipant& participant) {
    const std::size_t kFewest = 2 * 5 + 2 * 4;  // two texts, two counts
    if (!ReadGid(participant.gid)) return false;
    const auto count = reader_.GetCount(kFewest);
    if (!count) return false;
    participant.nodes.resize(*count);
    return std::ranges::all_of(participant.nodes, [&](RosNode& node) {
      return ReadName(node.name_space) && ReadName(node.name) && ReadGids(node.readers) &&
             ReadGids(node.writers);
    });
  }

 private:
  bool ReadName(std::string& name) {
    return reader_.GetText(name) && name.size() <= kLongestName;
  }
  bool ReadGid(RosGid& gid) {
    return reader_.GetPlain(gid.data(), 1, gid.size()) && reader_.Skip(1, SizeOf(layout_) - gid.size());
  }
  bool ReadGids(std::vector<RosGid>& gids) {
    const auto count = reader_.GetCount(SizeOf(layout_));
    if (!count) return false;
    gids.resize(*count);
    return std::ranges::all_of(gids, [&](RosGid& gid) { return ReadGid(gid); });
  }

  CdrReader& reader_;
  const RosGidLayout layout_;
};

}  // namespace

Result<RosGidLayout> FindRosGidLayout(std::string_view distribution) {
  constexpr std::string_view kHumble[] = {"foxy", "galactic", "humble"};
  constexpr std::string_view kIron[] = {"iron", "jazzy", "kilted", "rolling"};
  if (std::ranges::find(kHumble, distribution) != std::end(kHumble)) return RosGidLayout::kHumble;
  if (std::ranges::find(kIron, distribution) != std::end(kIron)) return RosGidLayout::kIron;
  std::vector<std::string> names(std::begin(kHumble), std::end(kHumble));
  names.insert(names.end(), std::begin(kIron), std::end(kIron));
  return Error{.message = "there is no distribution '" + std::string(distribution) + "' of ROS 2",
               .hint = NearestNameHint(distribution, names)};
}

void WriteDiscoveryInfo(const RosParticipant& participant, RosGidLayout layout, std::vector<std::byte>& octets) {
  CdrWriter writer(octets);
  WriteGid(participant.gid, layout, writer);
  writer.PutCount(participant.nodes.size());
  for (const RosNode& node : participant.nodes) {
    writer.PutText(node.name_space.substr(0, kLongestName));
    writer.PutText(node.name.substr(0, kLongestName));
    WriteGids(node.readers, layout, writer);
    WriteGids(node.writers, layout, writer);
  }
}

Result<ReadParticipant> ReadDiscoveryInfo(std::span<const std::byte> octets) {
  auto reader = CdrReader::Begin(octets);
  if (!reader) return reader.error();
  ReadParticipant read{.participant = {}, .layout = LayoutOf(octets)};
  if (InfoReader(*reader, read.layout).Read(read.participant)) return read;
  return Error{.message = "the octets are no message of ros_discovery_info"};
}

}  // namespace runnel
