// A node as those of ROS 2 are on Cyclone DDS, with types that Cyclone's own generator has made: nothing of Runnel is in
// it. It says on standard output what it reads:
//
//     ros_node DOMAIN scan|clock|log|graph|tf|tf_static  prints what comes
//     ros_node DOMAIN graph_of_humble                    the same as nodes of Humble read it
//     ros_node DOMAIN reliable_scan|latched_tf|other_scan  asks for more than is offered, or for another type
//     ros_node DOMAIN deadline_scan|liveliness_scan|partition_scan|xcdr2_scan  asks for what Runnel does not offer
//     ros_node DOMAIN other_twist                        sends other messages under the name of twists, and says so
//     ros_node DOMAIN twist                              tells a robot to go, 20 times a second, as the node /pilots/joystick

#include <algorithm>
#include <chrono>
#include <cstddef>
#include <cstdint>
#include <cstdio>
#include <cstdlib>
#include <cstring>
#include <iterator>
#include <string>
#include <thread>

#include <dds/dds.h>
#include <humble_graph.h>
#include <ros_messages.h>

namespace {

constexpr const char* kSettings =
    "<General><Interfaces><NetworkInterface name=\"lo\" multicast=\"true\"/></Interfaces></General>";

dds_qos_t* Qos(bool is_reliable, bool is_latched) {
  dds_qos_t* const qos = dds_create_qos();
  dds_qset_reliability(qos, is_reliable ? DDS_RELIABILITY_RELIABLE : DDS_RELIABILITY_BEST_EFFORT, DDS_SECS(1));
  dds_qset_durability(qos, is_latched ? DDS_DURABILITY_TRANSIENT_LOCAL : DDS_DURABILITY_VOLATILE);
  dds_qset_history(qos, DDS_HISTORY_KEEP_LAST, 10);
  return qos;
}

template <typename Message, typename Print>
void Read(dds_entity_t participant, const dds_topic_descriptor_t& type, const char* name, dds_qos_t* qos,
          const Print& print) {
  const dds_entity_t topic = dds_create_topic(participant, &type, name, nullptr, nullptr);
  const dds_entity_t reader = dds_create_reader(participant, topic, qos, nullptr);
  for (;;) {
    void* samples[1] = {};
    dds_sample_info_t info;
    if (dds_take(reader, samples, &info, 1, 1) > 0) {
      if (info.valid_data) print(*static_cast<const Message*>(samples[0]));
      std::fflush(stdout);
      (void)dds_return_loan(reader, samples, 1);
    } else {
      std::this_thread::sleep_for(std::chrono::milliseconds(5));
    }
  }
}

template <typename Info>
void ShowNodes(const Info& info) {
  for (std::uint32_t i = 0; i < info.node_entities_info_seq._length; ++i) {
    const auto& node = info.node_entities_info_seq._buffer[i];
    std::printf("node %s %s readers %u writers %u\n", node.node_namespace, node.node_name, node.reader_gid_seq._length,
                node.writer_gid_seq._length);
    for (std::uint32_t j = 0; j < node.writer_gid_seq._length; ++j) {
      const auto& gid = node.writer_gid_seq._buffer[j].data;
      const bool is_of_participant = std::memcmp(gid, info.gid.data, 12) == 0;
      const bool is_filled = std::all_of(gid + 16, std::end(gid), [](std::uint8_t each) { return each == 0; });
      if (!is_of_participant || !is_filled) std::printf("a writer of another participant\n");
    }
  }
}

// Who reads so gets nothing.
void Ask(dds_entity_t participant, const dds_topic_descriptor_t& type, const char* name, dds_qos_t* qos) {
  Read<std::byte>(participant, type, name, qos, [](const std::byte&) { std::printf("a value came\n"); });
}

// The policies that ROS 2 leaves as they are, but for who sets them.
dds_qos_t* StrictQos(const std::string& what) {
  dds_qos_t* const qos = Qos(false, false);
  const char* const partition = "lab";
  const dds_data_representation_id_t newer = DDS_DATA_REPRESENTATION_XCDR2;
  if (what == "deadline_scan") dds_qset_deadline(qos, DDS_MSECS(100));
  if (what == "liveliness_scan") dds_qset_liveliness(qos, DDS_LIVELINESS_MANUAL_BY_TOPIC, DDS_SECS(1));
  if (what == "partition_scan") dds_qset_partition1(qos, partition);
  if (what == "xcdr2_scan") dds_qset_data_representation(qos, 1, &newer);
  return qos;
}

void PutId(dds_entity_t entity, rmw_dds_common_msg_dds__Gid_& gid) {
  dds_guid_t id{};
  (void)dds_get_guid(entity, &id);
  std::memcpy(gid.data, id.v, sizeof gid.data);
}

// That the writer is one of the node's.
void TellNode(dds_entity_t participant, dds_entity_t writer, const char* name_space, const char* name) {
  const dds_entity_t topic = dds_create_topic(participant, &rmw_dds_common_msg_dds__ParticipantEntitiesInfo__desc,
                                              "ros_discovery_info", nullptr, nullptr);
  const dds_entity_t nodes = dds_create_writer(participant, topic, Qos(true, true), nullptr);
  rmw_dds_common_msg_dds__Gid_ gid{};
  PutId(writer, gid);
  rmw_dds_common_msg_dds__NodeEntitiesInfo_ node{};
  (void)std::snprintf(node.node_namespace, sizeof node.node_namespace, "%s", name_space);
  (void)std::snprintf(node.node_name, sizeof node.node_name, "%s", name);
  node.writer_gid_seq = {1, 1, &gid, false};
  rmw_dds_common_msg_dds__ParticipantEntitiesInfo_ info{};
  PutId(participant, info.gid);
  info.node_entities_info_seq = {1, 1, &node, false};
  (void)dds_write(nodes, &info);
}

void SendOthers(dds_entity_t participant) {
  dds_topic_descriptor_t type = sensor_msgs_msg_dds__LaserScan__desc;
  type.m_typename = geometry_msgs_msg_dds__Twist__desc.m_typename;
  dds_qos_t* const qos = Qos(true, false);
  const std::string said = "typehash=RIHS01_64c19139;";
  dds_qset_userdata(qos, said.data(), said.size());
  const dds_entity_t topic = dds_create_topic(participant, &type, "rt/cmd_vel", nullptr, nullptr);
  const dds_entity_t writer = dds_create_writer(participant, topic, qos, nullptr);
  for (;;) {
    float ranges[] = {1, 2, 3};
    sensor_msgs_msg_dds__LaserScan_ scan{};
    scan.header.frame_id = const_cast<char*>("laser");
    scan.ranges._buffer = ranges;
    scan.ranges._length = scan.ranges._maximum = 3;
    (void)dds_write(writer, &scan);
    std::this_thread::sleep_for(std::chrono::milliseconds(50));
  }
}

}  // namespace

int main(int argc, char** argv) {
  if (argc < 3) return 2;
  const auto domain = static_cast<dds_domainid_t>(std::atoi(argv[1]));
  const std::string what = argv[2];
  if (dds_create_domain(domain, kSettings) < 0) return 1;
  const dds_entity_t participant = dds_create_participant(domain, nullptr, nullptr);
  if (participant < 0) return 1;
  if (what == "scan") {
    Read<sensor_msgs_msg_dds__LaserScan_>(
        participant, sensor_msgs_msg_dds__LaserScan__desc, "rt/scan", Qos(false, false), [](const auto& scan) {
          std::printf("scan frame %s ranges %u from %.3f step %.5f most %.2f first %.3f stamped %s\n",
                      scan.header.frame_id, scan.ranges._length, static_cast<double>(scan.angle_min),
                      static_cast<double>(scan.angle_increment), static_cast<double>(scan.range_max),
                      static_cast<double>(scan.ranges._buffer[0]),
                      scan.header.stamp.sec > 0 || scan.header.stamp.nanosec > 0 ? "yes" : "no");
        });
  }
  if (what == "clock") {
    Read<rosgraph_msgs_msg_dds__Clock_>(
        participant, rosgraph_msgs_msg_dds__Clock__desc, "rt/clock", Qos(false, false),
        [](const auto& time) { std::printf("clock %d.%09u\n", time.clock.sec, time.clock.nanosec); });
  }
  if (what == "log") {
    Read<rcl_interfaces_msg_dds__Log_>(
        participant, rcl_interfaces_msg_dds__Log__desc, "rt/rosout", Qos(true, true),
        [](const auto& log) { std::printf("log %u %s: %s\n", log.level, log.name, log.msg); });
  }
  if (what == "graph") {
    Read<rmw_dds_common_msg_dds__ParticipantEntitiesInfo_>(
        participant, rmw_dds_common_msg_dds__ParticipantEntitiesInfo__desc, "ros_discovery_info", Qos(true, true),
        [](const auto& info) { ShowNodes(info); });
  }
  if (what == "graph_of_humble") {
    dds_topic_descriptor_t type = humble_ParticipantEntitiesInfo__desc;
    type.m_typename = "rmw_dds_common::msg::dds_::ParticipantEntitiesInfo_";
    Read<humble_ParticipantEntitiesInfo_>(participant, type, "ros_discovery_info", Qos(true, true),
                                          [](const auto& info) { ShowNodes(info); });
  }
  if (what == "reliable_scan") Ask(participant, sensor_msgs_msg_dds__LaserScan__desc, "rt/scan", Qos(true, false));
  for (const char* const each : {"deadline_scan", "liveliness_scan", "partition_scan", "xcdr2_scan"}) {
    if (what == each) Ask(participant, sensor_msgs_msg_dds__LaserScan__desc, "rt/scan", StrictQos(what));
  }
  if (what == "latched_tf") Ask(participant, tf2_msgs_msg_dds__TFMessage__desc, "rt/tf", Qos(true, true));
  if (what == "other_twist") SendOthers(participant);
  if (what == "other_scan") Ask(participant, rosgraph_msgs_msg_dds__Clock__desc, "rt/scan", Qos(false, false));
  if (what == "tf" || what == "tf_static") {
    Read<tf2_msgs_msg_dds__TFMessage_>(
        participant, tf2_msgs_msg_dds__TFMessage__desc, ("rt/" + what).c_str(), Qos(true, what == "tf_static"),
        [](const auto& message) {
          for (std::uint32_t i = 0; i < message.transforms._length; ++i) {
            const auto& each = message.transforms._buffer[i];
            std::printf("transform %s to %s at %.1f %.1f turned %.1f\n", each.header.frame_id, each.child_frame_id,
                        each.transform.translation.x, each.transform.translation.y, each.transform.rotation.w);
          }
        });
  }
  const dds_entity_t topic =
      dds_create_topic(participant, &geometry_msgs_msg_dds__Twist__desc, "rt/cmd_vel", nullptr, nullptr);
  const dds_entity_t writer = dds_create_writer(participant, topic, Qos(true, false), nullptr);
  TellNode(participant, writer, "/pilots", "joystick");
  for (;;) {
    geometry_msgs_msg_dds__Twist_ twist{};
    twist.linear.x = 0.25;
    twist.angular.z = -0.5;
    (void)dds_write(writer, &twist);
    std::this_thread::sleep_for(std::chrono::milliseconds(50));
  }
}
