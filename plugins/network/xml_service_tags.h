#pragma once

#include "plugins/application_files/xml_tag.h"

namespace runnel {

class FrameworkElement;
class Port;

/// <offer port="mapper/save" service="/save_map"/>: whether the port is a service, or was to be one. Mistakes are reported.
bool OfferService(const TagUse& use, const Port& port);
/// <take service="/save_map" to="planner/save"/>.
FrameworkElement* TakeService(const TagUse& use);

}  // namespace runnel
