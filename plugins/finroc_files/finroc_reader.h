#pragma once

#include <filesystem>
#include <list>
#include <string>
#include <vector>

#include "core/xml/xml_document.h"
#include "plugins/application_files/build_context.h"
#include "plugins/application_files/path_use.h"

namespace runnel::internal {

/// Makes what a FINROC file describes below an application, and warns of the rest.
///
/// Threads: under the structure lock.
class FinrocReader {
 public:
  FinrocReader(FrameworkElement& application, BuildContext& context) : application_(application), context_(context) {}

  void Read(XmlElement root, const std::filesystem::path& file);

 private:
  void ReadContents(XmlElement root, FrameworkElement& group, const std::filesystem::path& file);
  void LoadLibraries(XmlElement root);
  // Whether the plugin is loaded now.
  bool LoadLibrary(const std::string& plugin);
  void ReadElement(XmlElement element, FrameworkElement& parent, const std::filesystem::path& file);
  void ReadGroup(XmlElement element, const std::string& type, FrameworkElement& group,
                 const std::filesystem::path& file);
  void ReadModule(XmlElement element, FrameworkElement& parent);
  void ReadStaticParameters(XmlElement element, FrameworkElement& module);
  void MakeThread(XmlElement element, FrameworkElement& group);
  void AddThread(const std::string& name, Duration period, FrameworkElement& of);
  void ReadInterface(XmlElement interface, FrameworkElement& group);
  void ReadEdge(XmlElement edge, FrameworkElement& group);
  Port* FindEnd(const XmlAttribute& path, FrameworkElement& group, PathKind end);
  void ReadConversion(XmlElement conversion, FrameworkElement& group, ConnectOptions& options);
  ConnectOptions ReadFlags(XmlElement edge, FrameworkElement& group);
  void ReadParameterLinks(XmlElement links, const std::string& path, FrameworkElement& group);
  // `module` and `name` seen from the group.
  void ReadParameter(XmlElement parameter, const std::string& module, const std::string& name, FrameworkElement& group);

  void Warn(std::string message, std::string hint, const SourcePosition& position, const FrameworkElement& element);

  FrameworkElement& application_;
  BuildContext& context_;
  std::vector<std::filesystem::path> open_;
  std::list<XmlDocument> documents_;
  bool has_thread_ = false;
  bool is_too_large_ = false;
};

}  // namespace runnel::internal
