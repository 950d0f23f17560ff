#pragma once

#include "core/xml/xml_document.h"
#include "plugins/runtime_construction/build_context.h"
#include "plugins/runtime_construction/xml_tag.h"

namespace runnel {

/// Goes through an application file once, from top to bottom: checks every tag against what the
/// registry knows, and has those that are right handled. What stands in a tag that could not be
/// handled is still checked.
///
/// Errors: all go to the context.
class ApplicationReader {
 public:
  explicit ApplicationReader(BuildContext& context) : context_(context) {}

  /// What the root tag has made; nullptr if it could not.
  FrameworkElement* Read(XmlElement root);

 private:
  enum class Mode { kHandle, kCheckOnly };

  // Those that come first, or those that do not.
  void ReadChildren(XmlElement element, FrameworkElement& parent, Mode mode, bool first);
  void ReadTag(const XmlTag& tag, XmlElement element, FrameworkElement& parent, Mode mode);
  void CheckContents(XmlElement element, FrameworkElement& parent);
  // False if the tag cannot be handled.
  bool CheckAttributesOf(const XmlTag& tag, TagUse& use);
  FrameworkElement* Handle(const XmlTag& tag, const TagUse& use);
  void HandleAddedAttributes(const XmlTag& tag, const TagUse& use, FrameworkElement& made);
  void Report(Error error, const SourcePosition& position, const TagUse& use);

  BuildContext& context_;
};

}  // namespace runnel
