#pragma once

#include "core/xml/xml_document.h"
#include "plugins/runtime_construction/build_context.h"
#include "plugins/runtime_construction/xml_tag.h"

namespace runnel {

/// Goes through an application file once, from top to bottom: checks every tag against what the
/// registry knows, and has those that are right handled. What stands in a tag that could not be
/// handled is still checked. Once an error is certain, nothing of the tree will stay: so a misspelt
/// word is taken for the nearest one, and a tag that lacks but its name gets a stand-in, in order
/// to tell what else is wrong.
///
/// Errors: all go to the context.
class ApplicationReader {
 public:
  explicit ApplicationReader(BuildContext& context);

  /// What the root tag has made; nullptr if it could not.
  FrameworkElement* Read(XmlElement root);

 private:
  enum class Mode { kHandle, kCheckOnly };

  Result<void> ReadPart(const XmlAttribute& type, XmlElement tag, FrameworkElement& group);
  void CheckParameters(PartUse& part);
  // Those that come first, or those that do not.
  void ReadChildren(const XmlTag& tag, XmlElement element, FrameworkElement& parent, Mode mode,
                    bool first);
  void ReadTag(const XmlTag& tag, XmlElement element, FrameworkElement& parent, Mode mode);
  void ReadUnknownTag(XmlElement element, const std::vector<std::string>& known,
                      FrameworkElement& parent, Mode mode);
  void CheckContents(const XmlTag& tag, XmlElement element, FrameworkElement& parent);
  void NoteMisplacedLoads(XmlElement element);
  // False if the tag cannot be handled.
  bool CheckAttributesOf(const XmlTag& tag, TagUse& use);
  void ReadMisspeltAttributes(const std::vector<AttributeRule>& rules, TagUse& use);
  bool CheckAttribute(const AttributeRule& rule, TagUse& use);
  void GiveStandInName(TagUse& use);
  FrameworkElement* Handle(const XmlTag& tag, const TagUse& use);
  FrameworkElement* Salvage(const XmlTag& tag, const TagUse& use);
  void HandleAddedAttributes(const XmlTag& tag, const TagUse& use, FrameworkElement& made);
  void Report(Error error, const SourcePosition& position, const TagUse& use);

  BuildContext& context_;
};

}  // namespace runnel
