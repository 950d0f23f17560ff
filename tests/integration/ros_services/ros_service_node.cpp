// A node that calls services and has some, as those of ROS 2 on Cyclone DDS do, with types that Cyclone's own generator has
// made: nothing of Runnel is in it. It says on standard output what comes:
//
//     ros_service_node DOMAIN call         calls /lamp/switch (SetBool), /lamp/warm (Trigger), /lamp/reset (Empty)
//     ros_service_node DOMAIN call_early   calls /lamp/switch, and has the reader of the answer only 200 ms later
//     ros_service_node DOMAIN stop         calls /house/stop (SetBool) with true, then with false
//     ros_service_node DOMAIN serve        has /house/switch (SetBool), which refuses each second call
//     ros_service_node DOMAIN parameters   lists, describes, gets and sets parameters of the node /house
//     ros_service_node DOMAIN events       shows what comes on /parameter_events
//     ros_service_node DOMAIN diagnostics  shows what comes on /diagnostics
//     ros_service_node DOMAIN clock        says on /clock that it is 100 s, and 50 ms later 20 times a second

#include <cstdlib>

#include <ros_services.h>

#include "tests/integration/ros_services/ros_service_ends.h"

namespace {

constexpr const char* kSettings =
    "<General><Interfaces><NetworkInterface name=\"lo\" multicast=\"true\"/></Interfaces></General>";

void Call(dds_entity_t participant) {
  const Ends lamp = MakeClient(participant, "lamp/switch", std_srvs_srv_dds__SetBool_Request__desc,
                               std_srvs_srv_dds__SetBool_Response__desc);
  for (int count = 1; count <= 3; ++count) {
    std_srvs_srv_dds__SetBool_Request_ request{};
    request.data = count != 2;
    CallOnce<std_srvs_srv_dds__SetBool_Response_>(lamp, request, [&](const auto& response) {
      std::printf("switch %d: %s '%s'\n", count, response.success ? "done" : "refused", response.message);
    });
  }
  const Ends warm = MakeClient(participant, "lamp/warm", std_srvs_srv_dds__Trigger_Request__desc,
                               std_srvs_srv_dds__Trigger_Response__desc);
  CallOnce<std_srvs_srv_dds__Trigger_Response_>(warm, std_srvs_srv_dds__Trigger_Request_{}, [](const auto& response) {
    std::printf("warm: %s '%s'\n", response.success ? "done" : "refused", response.message);
  });
  const Ends reset = MakeClient(participant, "lamp/reset", std_srvs_srv_dds__Empty_Request__desc,
                                std_srvs_srv_dds__Empty_Response__desc);
  CallOnce<std_srvs_srv_dds__Empty_Response_>(reset, std_srvs_srv_dds__Empty_Request_{},
                                              [](const auto&) { std::printf("reset: done\n"); });
}

// As clients do that call as soon as they know the service, which may know their readers later.
void CallEarly(dds_entity_t participant) {
  const dds_entity_t out = dds_create_topic(participant, &std_srvs_srv_dds__SetBool_Request__desc,
                                            "rq/lamp/switchRequest", nullptr, nullptr);
  const dds_entity_t in =
      dds_create_topic(participant, &std_srvs_srv_dds__SetBool_Response__desc, "rr/lamp/switchReply", nullptr, nullptr);
  const dds_entity_t writer = dds_create_writer(participant, out, ServiceQos("clientid=5.6;").get(), nullptr);
  dds_publication_matched_status_t readers{};
  while (readers.current_count == 0) {
    Pause();
    (void)dds_get_publication_matched_status(writer, &readers);
  }
  std_srvs_srv_dds__SetBool_Request_ request{};
  request.client = kClient;
  request.number = 1;
  request.data = true;
  (void)dds_write(writer, &request);
  (void)dds_wait_for_acks(writer, DDS_SECS(10));
  std::this_thread::sleep_for(std::chrono::milliseconds(200));
  const dds_entity_t reader = dds_create_reader(participant, in, ServiceQos("clientid=5.6;").get(), nullptr);
  TakeUntil<std_srvs_srv_dds__SetBool_Response_>(reader, [](const auto& response) {
    std::printf("early: %s '%s'\n", response.success ? "done" : "refused", response.message);
    return true;
  });
}

void Stop(dds_entity_t participant) {
  const Ends stop = MakeClient(participant, "house/stop", std_srvs_srv_dds__SetBool_Request__desc,
                               std_srvs_srv_dds__SetBool_Response__desc);
  for (const bool data : {true, false}) {
    std_srvs_srv_dds__SetBool_Request_ request{};
    request.data = data;
    CallOnce<std_srvs_srv_dds__SetBool_Response_>(stop, request, [&](const auto& response) {
      std::printf("stop %d: %s '%s'\n", data ? 1 : 0, response.success ? "done" : "refused", response.message);
    });
  }
}

void Serve(dds_entity_t participant) {
  const dds_entity_t in = dds_create_topic(participant, &std_srvs_srv_dds__SetBool_Request__desc,
                                           "rq/house/switchRequest", nullptr, nullptr);
  const dds_entity_t out = dds_create_topic(participant, &std_srvs_srv_dds__SetBool_Response__desc,
                                            "rr/house/switchReply", nullptr, nullptr);
  const Ends ends{dds_create_writer(participant, out, ServiceQos("serviceid=2;").get(), nullptr),
                  dds_create_reader(participant, in, ServiceQos("serviceid=2;").get(), nullptr)};
  int count = 0;
  TakeUntil<std_srvs_srv_dds__SetBool_Request_>(ends.reader, [&](const auto& request) {
    std::printf("asked %d: %s\n", ++count, request.data ? "on" : "off");
    std::string message = count % 2 == 1 ? "lights are on" : "the fuse is out";
    std_srvs_srv_dds__SetBool_Response_ response{};
    response.client = request.client + 1;  // to somebody else: nobody of Runnel's may take it
    response.number = request.number;
    response.success = true;
    response.message = message.data();
    (void)dds_write(ends.writer, &response);
    response.client = request.client;
    response.success = count % 2 == 1;
    (void)dds_write(ends.writer, &response);
    return false;
  });
}

std::string TextOf(const rcl_interfaces_msg_dds__ParameterValue_& value) {
  switch (value.type) {
    case 1:
      return value.bool_value ? "true" : "false";
    case 2:
      return std::to_string(value.integer_value);
    case 3:
      return std::to_string(value.double_value);
    case 4:
      return "'" + std::string(value.string_value) + "'";
    default:
      return "type " + std::to_string(value.type);
  }
}

void ShowAll(const char* what, const dds_sequence_rcl_interfaces_msg_dds__Parameter_& parameters) {
  for (std::uint32_t i = 0; i < parameters._length; ++i) {
    const auto& each = parameters._buffer[i];
    std::printf("%s %s %s\n", what, each.name, TextOf(each.value).c_str());
  }
}

rcl_interfaces_msg_dds__Parameter_ Wanted(const char* name, double value) {
  rcl_interfaces_msg_dds__Parameter_ wanted{};
  wanted.name = const_cast<char*>(name);
  wanted.value.type = 3;
  wanted.value.double_value = value;
  wanted.value.string_value = const_cast<char*>("");
  return wanted;
}

template <typename Request>
Request Names(char** names, std::uint32_t count) {
  Request request{};
  request.names._buffer = names;
  request.names._length = request.names._maximum = count;
  return request;
}

#define CLIENT(participant, name, type)                                                                 \
  MakeClient(participant, std::string("house/") + name, rcl_interfaces_srv_dds__##type##_Request__desc, \
             rcl_interfaces_srv_dds__##type##_Response__desc)

void Parameters(dds_entity_t participant) {
  const Ends list = CLIENT(participant, "list_parameters", ListParameters),
             get = CLIENT(participant, "get_parameters", GetParameters),
             types = CLIENT(participant, "get_parameter_types", GetParameterTypes),
             describe = CLIENT(participant, "describe_parameters", DescribeParameters),
             set = CLIENT(participant, "set_parameters", SetParameters),
             atomically = CLIENT(participant, "set_parameters_atomically", SetParametersAtomically);
  CallOnce<rcl_interfaces_srv_dds__ListParameters_Response_>(
      list, rcl_interfaces_srv_dds__ListParameters_Request_{}, [](const auto& response) {
        for (std::uint32_t i = 0; i < response.result.names._length; ++i)
          std::printf("listed %s\n", response.result.names._buffer[i]);
        for (std::uint32_t i = 0; i < response.result.prefixes._length; ++i)
          std::printf("prefix %s\n", response.result.prefixes._buffer[i]);
      });
  char* names[] = {const_cast<char*>("lamp.is_broken"), const_cast<char*>("lamp.level"),
                   const_cast<char*>("lamp.nothing")};
  CallOnce<rcl_interfaces_srv_dds__GetParameterTypes_Response_>(
      types, Names<rcl_interfaces_srv_dds__GetParameterTypes_Request_>(names, 3), [](const auto& response) {
        for (std::uint32_t i = 0; i < response.types._length; ++i)
          std::printf("type %u is %u\n", i, response.types._buffer[i]);
      });
  CallOnce<rcl_interfaces_srv_dds__DescribeParameters_Response_>(
      describe, Names<rcl_interfaces_srv_dds__DescribeParameters_Request_>(names + 1, 1), [](const auto& response) {
        const auto& level = response.descriptors._buffer[0];
        std::printf("described %s: '%s' %s", level.name, level.description, level.read_only ? "read only" : "open");
        if (level.floating_point_range._length == 1) {
          std::printf(" from %g to %g", level.floating_point_range._buffer[0].from_value,
                      level.floating_point_range._buffer[0].to_value);
        }
        std::printf("\n");
      });
  rcl_interfaces_msg_dds__Parameter_ wanted[] = {Wanted("lamp.level", 3.5), Wanted("lamp.level", 99),
                                                 Wanted("lamp.levl", 1), Wanted("lamp.is_broken", 1)};
  rcl_interfaces_srv_dds__SetParameters_Request_ setting{};
  setting.parameters._buffer = wanted;
  setting.parameters._length = setting.parameters._maximum = 4;
  CallOnce<rcl_interfaces_srv_dds__SetParameters_Response_>(set, setting, [](const auto& response) {
    for (std::uint32_t i = 0; i < response.results._length; ++i) {
      std::printf("set %u: %s '%s'\n", i, response.results._buffer[i].successful ? "done" : "refused",
                  response.results._buffer[i].reason);
    }
  });
  rcl_interfaces_msg_dds__Parameter_ both[] = {Wanted("lamp.level", 7), Wanted("lamp.level", 77)};
  rcl_interfaces_srv_dds__SetParametersAtomically_Request_ together{};
  together.parameters._buffer = both;
  together.parameters._length = together.parameters._maximum = 2;
  CallOnce<rcl_interfaces_srv_dds__SetParametersAtomically_Response_>(atomically, together, [](const auto& response) {
    std::printf("together: %s '%s'\n", response.result.successful ? "done" : "refused", response.result.reason);
  });
  CallOnce<rcl_interfaces_srv_dds__GetParameters_Response_>(
      get, Names<rcl_interfaces_srv_dds__GetParameters_Request_>(names, 3), [&](const auto& response) {
        for (std::uint32_t i = 0; i < response.values._length; ++i)
          std::printf("got %s %s\n", names[i], TextOf(response.values._buffer[i]).c_str());
      });
}

dds_entity_t Reader(dds_entity_t participant, const char* topic, const dds_topic_descriptor_t& type) {
  return dds_create_reader(participant, dds_create_topic(participant, &type, topic, nullptr, nullptr),
                           ServiceQos("", 1000).get(), nullptr);
}

void Events(dds_entity_t participant) {
  const dds_entity_t reader = Reader(participant, "rt/parameter_events", rcl_interfaces_msg_dds__ParameterEvent__desc);
  dds_subscription_matched_status_t status{};
  while (status.current_count == 0) {
    Pause();
    (void)dds_get_subscription_matched_status(reader, &status);
  }
  std::printf("listening\n");
  std::fflush(stdout);
  TakeUntil<rcl_interfaces_msg_dds__ParameterEvent_>(reader, [](const auto& event) {
    std::printf("event of %s\n", event.node);
    ShowAll("new", event.new_parameters);
    ShowAll("changed", event.changed_parameters);
    ShowAll("deleted", event.deleted_parameters);
    return false;
  });
}

void Diagnostics(dds_entity_t participant) {
  const dds_entity_t reader = Reader(participant, "rt/diagnostics", diagnostic_msgs_msg_dds__DiagnosticArray__desc);
  TakeUntil<diagnostic_msgs_msg_dds__DiagnosticArray_>(reader, [](const auto& array) {
    for (std::uint32_t i = 0; i < array.status._length; ++i) {
      const auto& status = array.status._buffer[i];
      std::printf("level %u %s: %s\n", status.level, status.name, status.message);
    }
    return false;
  });
}

void TellTime(dds_entity_t participant) {
  const Qos qos = ServiceQos("", 1);
  dds_qset_reliability(qos.get(), DDS_RELIABILITY_BEST_EFFORT, 0);
  const dds_entity_t topic =
      dds_create_topic(participant, &rosgraph_msgs_msg_dds__Clock__desc, "rt/clock", nullptr, nullptr);
  const dds_entity_t writer = dds_create_writer(participant, topic, qos.get(), nullptr);
  for (std::int64_t milliseconds = 100'000;; milliseconds += 50) {
    rosgraph_msgs_msg_dds__Clock_ clock{};
    clock.clock.sec = static_cast<std::int32_t>(milliseconds / 1000);
    clock.clock.nanosec = static_cast<std::uint32_t>(milliseconds % 1000 * 1'000'000);
    (void)dds_write(writer, &clock);
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
  if (what == "call") Call(participant);
  if (what == "call_early") CallEarly(participant);
  if (what == "stop") Stop(participant);
  if (what == "serve") Serve(participant);
  if (what == "parameters") Parameters(participant);
  if (what == "events") Events(participant);
  if (what == "diagnostics") Diagnostics(participant);
  if (what == "clock") TellTime(participant);
  std::fflush(stdout);
}
