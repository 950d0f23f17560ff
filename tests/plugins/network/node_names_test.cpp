// Nodes of ROS 2 are called by their names, though all their members may have one name or none; and no name of others can do
// more than be read.
#include <gmock/gmock.h>

#include "plugins/cdr_values/cdr_stream.h"
#include "plugins/network_discovery/discovery_table.h"
#include "tests/plugins/network/network_member.h"

namespace runnel::test {
namespace {

using testing::AllOf;
using testing::HasSubstr;
using testing::Not;

struct NodeSaid {
  std::string name_space, name;
  std::vector<WireId> readers = {}, writers = {};
};

WireId Id(int number) {
  WireId id{};
  id[0] = static_cast<std::uint8_t>(number);
  return id;
}

// As up to Humble ids have 24 octets, the last of which are 0.
Octets Said(const WireId& member, const std::vector<NodeSaid>& nodes, bool is_long) {
  Octets octets;
  CdrWriter to(octets);
  const auto put = [&](const WireId& id) {
    to.PutPlain(id.data(), 1, id.size());
    constexpr std::array<std::uint8_t, 8> kFill{};
    if (is_long) to.PutPlain(kFill.data(), 1, kFill.size());
  };
  put(member);
  to.PutCount(nodes.size());
  for (const NodeSaid& each : nodes) {
    to.PutText(each.name_space);
    to.PutText(each.name);
    for (const auto& ids : {each.readers, each.writers}) {
      to.PutCount(ids.size());
      for (const WireId& id : ids) put(id);
    }
  }
  return octets;
}

std::string NameBy(std::span<const std::byte> said) {
  DiscoveryTable table([] {});
  table.OnMember({Id(9), "/", "enclave=/;"});
  table.OnNodes(said);
  return table.NameOf(Id(9));
}

class NodeNamesTest : public testing::TestWithParam<bool> {};

TEST_P(NodeNamesTest, AreThoseOfAMember) {
  const std::vector<NodeSaid> nodes{{"/", "talker", {Id(1)}, {Id(2), Id(3)}}, {"/robots", "base", {}, {Id(4)}}};
  EXPECT_EQ(NameBy(Said(Id(9), nodes, GetParam())), "/talker, /robots/base");
  EXPECT_EQ(NameBy(Said(Id(9), {}, GetParam())), "/") << "it has none";
  EXPECT_EQ(NameBy(Said(Id(8), nodes, GetParam())), "/") << "of another one";
}

TEST_P(NodeNamesTest, WhatIsCutShortOrNothingOfTheKindIsNone) {
  const Octets whole = Said(Id(9), {{"/", "talker", {Id(1)}, {Id(2)}}}, GetParam());
  EXPECT_EQ(NameBy(whole), "/talker");
  for (std::size_t size = 0; size < whole.size(); ++size) EXPECT_EQ(NameBy(std::span(whole).first(size)), "/") << size;
  for (std::size_t i = 4; i < whole.size(); ++i) {
    Octets other = whole;
    other[i] = std::byte{0xff};
    (void)NameBy(other);
  }
}

INSTANTIATE_TEST_SUITE_P(Layouts, NodeNamesTest, testing::Bool());

/// As a process with a node on Fast DDS.
class ForeignNode {
 public:
  ForeignNode(WireEngine& engine, const std::string& member) {
    participant_ = Must(engine.Join({.name = member, .user_data = "enclave=/;"}, table_));
    const auto form = Must(ValueForm::Make(TypeOf<Place>(), "", ""));
    writer_ = Must(participant_->MakeWriter(
        {.topic = "rt/drive", .type = form->codec->dds_type(), .user_data = form->user_data}, {}));
  }
  void Tell(const std::string& name) {
    nodes_ =
        Must(participant_->MakeWriter({.topic = kNodesTopic, .type = kNodesType, .qos = {.is_latched = true}}, {}));
    const auto octets = std::make_shared<Octets>(Said(participant_->id(), {{"/", name, {}, {writer_->id()}}}, false));
    EXPECT_TRUE(nodes_->Write(octets, 1));
  }

 private:
  DiscoveryTable table_{[] {}};
  std::unique_ptr<WireParticipant> participant_;
  std::unique_ptr<WireWriter> writer_;
  std::unique_ptr<WireWriter> nodes_;
};

TEST(NamesOfOthersTest, NodesAreCalledByTheirNames) {
  const auto engine = MakeFakeWire();
  Member robot(*engine, "robot");
  robot.Take({.topic = "/drive"}, robot.module.goal);
  robot.Begin();
  ForeignNode joystick(*engine, "/");
  robot.WaitFor("/ is in the network");
  joystick.Tell("joystick");
  ForeignNode navigator(*engine, "");
  navigator.Tell("navigator");
  robot.WaitFor("/joystick is in the network");
  robot.WaitFor("/navigator is in the network");
  robot.WaitFor("write it, and all of them are heard");
  EXPECT_THAT(robot.Text(),
              AllOf(HasSubstr("member /joystick\n"), HasSubstr("member /navigator\n"),
                    HasSubstr("written by /joystick (reliable"), HasSubstr("written by /navigator (reliable")));
}

TEST(NamesOfOthersTest, CannotWriteToTheTerminal) {
  const auto engine = MakeFakeWire();
  Member robot(*engine, "robot");
  robot.Take({.topic = "/drive"}, robot.module.goal);
  robot.Begin();
  ForeignNode evil(*engine, "evil \x1b[31m\n12.0s error /drive: motors burn");
  robot.WaitFor("is in the network");
  ForeignNode worse(*engine, "");
  worse.Tell("worse\x1b[31m\n");
  robot.WaitFor("/worse\\x1b[31m\\x0a is in the network");
  for (const std::string& text : {robot.Text(), robot.said()}) {
    EXPECT_THAT(text, AllOf(Not(HasSubstr("\x1b")), Not(HasSubstr("\n12.0s"))));
  }
  EXPECT_THAT(robot.said(), HasSubstr("evil \\x1b[31m\\x0a12.0s error"));
}

}  // namespace
}  // namespace runnel::test
