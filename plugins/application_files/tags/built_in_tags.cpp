#include "plugins/application_files/tags/built_in_tags.h"

namespace runnel {

void AddBuiltInTags(XmlTagRegistry& tags) {
  for (const auto& make : {ApplicationTag, GroupTypeTag, LoadTag, ClockTag, ThreadTag, PortTag,
                           ModuleTag, ParameterTag, GroupTag, ConnectTag, LogTag, OnFaultTag,
                           OnStaleTag, OnStuckTag, OnPauseTag, LatencyTag, ProfileTag, OtherwiseTag}) {
    tags.AddTag(make());
  }
  for (XmlTag& tag : internal::ReactionTags()) tags.AddTag(std::move(tag));
  for (const char* tag : {"application", "group", "module"}) {
    tags.AddAttribute(ThreadAttribute(tag));
    tags.AddAttribute(ConfigurationAttribute(tag));
  }
}

}  // namespace runnel
