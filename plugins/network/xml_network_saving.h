#pragma once

#include "core/xml/xml_document.h"

namespace runnel {

class FrameworkElement;
namespace internal {
class FileUpdate;
}

/// Brings <network> of a file, and what is offered and taken there, up to what it is now (XmlTag::update).
void UpdateNetworkTag(XmlElement tag, FrameworkElement& application, internal::FileUpdate& update);

}  // namespace runnel
