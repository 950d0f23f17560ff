#pragma once

#include <chrono>
#include <cstdint>
#include <cstdio>
#include <memory>
#include <string>
#include <thread>

#include <dds/dds.h>

/// Ends of services as those of nodes on Cyclone DDS, made by Cyclone's own means.
inline constexpr std::uint64_t kClient = 0x0123456789abcdef;

struct QosDelete {
  void operator()(dds_qos_t* qos) const { dds_delete_qos(qos); }
};
using Qos = std::unique_ptr<dds_qos_t, QosDelete>;

inline Qos ServiceQos(const char* user_data, std::int32_t depth = 10) {
  Qos qos(dds_create_qos());
  dds_qset_reliability(qos.get(), DDS_RELIABILITY_RELIABLE, DDS_SECS(1));
  dds_qset_durability(qos.get(), DDS_DURABILITY_VOLATILE);
  dds_qset_history(qos.get(), DDS_HISTORY_KEEP_LAST, depth);
  dds_qset_userdata(qos.get(), user_data, std::string(user_data).size());
  return qos;
}

inline void Pause() { std::this_thread::sleep_for(std::chrono::milliseconds(5)); }

/// Takes messages until one is what `use` wants.
template <typename Message, typename Use>
void TakeUntil(dds_entity_t reader, const Use& use) {
  for (;;) {
    void* samples[1] = {};
    dds_sample_info_t info;
    if (dds_take(reader, samples, &info, 1, 1) <= 0) {
      Pause();
      continue;
    }
    const bool is_good = info.valid_data && use(*static_cast<const Message*>(samples[0]));
    std::fflush(stdout);
    (void)dds_return_loan(reader, samples, 1);
    if (is_good) return;
  }
}

struct Ends {
  dds_entity_t writer;
  dds_entity_t reader;

  void WaitUntilMatched() const {
    for (;;) {
      dds_publication_matched_status_t readers;
      dds_subscription_matched_status_t writers;
      (void)dds_get_publication_matched_status(writer, &readers);
      (void)dds_get_subscription_matched_status(reader, &writers);
      if (readers.current_count > 0 && writers.current_count > 0) return;
      Pause();
    }
  }
};

inline Ends MakeClient(dds_entity_t participant, const std::string& service, const dds_topic_descriptor_t& request,
                       const dds_topic_descriptor_t& response) {
  const dds_entity_t out =
      dds_create_topic(participant, &request, ("rq/" + service + "Request").c_str(), nullptr, nullptr);
  const dds_entity_t in =
      dds_create_topic(participant, &response, ("rr/" + service + "Reply").c_str(), nullptr, nullptr);
  return {dds_create_writer(participant, out, ServiceQos("clientid=1;").get(), nullptr),
          dds_create_reader(participant, in, ServiceQos("clientid=1;").get(), nullptr)};
}

/// Calls once there is a service, and shows its answer.
template <typename Response, typename Request, typename Show>
void CallOnce(const Ends& ends, Request request, const Show& show) {
  static std::int64_t number = 0;
  request.client = kClient;
  request.number = ++number;
  ends.WaitUntilMatched();
  (void)dds_write(ends.writer, &request);
  TakeUntil<Response>(ends.reader, [&](const Response& response) {
    if (response.client != kClient || response.number != request.number) return false;
    show(response);
    return true;
  });
}
