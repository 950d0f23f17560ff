#include "plugins/scheduling_tags/xml_scheduling_tags.h"

namespace runnel {

void AddSchedulingTags(XmlTagRegistry& tags) {
  tags.AddTag(internal::ClockTag());
  tags.AddTag(internal::ThreadTag());
  tags.AddTag(internal::OnFaultTag());
  for (const char* tag : {"application", "group", "module"}) {
    tags.AddAttribute(internal::ThreadAttribute(tag));
  }
}

namespace internal {

FrameworkElement& ApplicationOf(FrameworkElement& element) {
  FrameworkElement* at = &element;
  while (at->parent()->parent() != nullptr) at = at->parent();
  return *at;
}

}  // namespace internal

}  // namespace runnel
