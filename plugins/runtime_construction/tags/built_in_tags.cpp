#include "plugins/runtime_construction/tags/built_in_tags.h"

namespace runnel {

std::vector<XmlTag> BuiltInTags() {
  return {ApplicationTag(), GroupTypeTag(), LoadTag(),    GroupTag(),
          ModuleTag(),      PortTag(),      ConnectTag(), ParameterTag()};
}

}  // namespace runnel
