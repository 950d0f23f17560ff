#include "plugins/application_tags/application_tags.h"

#include "core/element/tags.h"
#include "plugins/application_files/build_context.h"
#include "plugins/application_tags/tag_list.h"

namespace runnel {

XmlTagRegistry ApplicationTags() {
  XmlTagRegistry tags;
  for (const auto& make : {ApplicationTag, GroupTypeTag, LoadTag, ClockTag, ThreadTag, PortTag, ModuleTag, ParameterTag,
                           InputTag, DrivingTag, GroupTag, ConnectTag, LogTag}) {
    tags.AddTag(make());
  }
  for (const auto& make : {internal::WatchingTags, internal::ReactionTags}) {
    for (XmlTag& tag : make()) tags.AddTag(std::move(tag));
  }
  for (const char* tag : {"application", "group", "module"}) {
    tags.AddAttribute(ThreadAttribute(tag));
    tags.AddAttribute(ConfigurationAttribute(tag));
    tags.AddAttribute(TagsAttribute(tag));
  }
  for (const char* tag : {"application", "thread"}) tags.AddAttribute(StuckAfterAttribute(tag));
  return tags;
}

AddedAttribute TagsAttribute(std::string tag) {
  return {.tag = std::move(tag),
          .rule = {.name = "tags", .summary = "words for viewers and plugins, separated by blanks: \"safety\""},
          .handle =
              [](const XmlAttribute& words, FrameworkElement& element, BuildContext& context) {
                const auto set = SetTags(element, TagsInText(words.value));
                if (!set) context.Report(set.error(), words.value_position, element);
              },
          .saved = TagsText};
}

}  // namespace runnel
