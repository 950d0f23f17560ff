#pragma once

#include <mutex>

#include <dds/dds.h>

#include "plugins/wire/wire.h"

namespace runnel {

/// Tells of members and endpoints what Cyclone's built-in topics say.
///
/// Threads: made and destroyed by one; calls back from Cyclone's.
class CycloneDiscovery {
 public:
  CycloneDiscovery(dds_entity_t participant, const WireId& own, WireDiscovery& listener);
  ~CycloneDiscovery();

 private:
  void TakeMembers(dds_entity_t reader);
  void TakeEndpoints(dds_entity_t reader, bool is_writer);
  dds_entity_t Read(dds_entity_t participant, dds_entity_t topic, dds_on_data_available_fn on_data);

  const WireId own_;
  WireDiscovery& listener_;
  std::mutex mutex_;  // Cyclone calls from several threads
  dds_entity_t members_;
  dds_entity_t writers_;
  dds_entity_t readers_;
};

/// The policies of an endpoint as Cyclone has them, and back. The caller deletes what it is given.
[[nodiscard]] WireQos QosOf(const dds_qos_t* qos);
[[nodiscard]] dds_qos_t* MakeQos(const WireEndpointOptions& options, bool is_writer);
[[nodiscard]] std::string UserDataOf(const dds_qos_t* qos);

}  // namespace runnel
