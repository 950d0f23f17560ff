#pragma once

#include "core/types/type_of.h"
#include "modules/types/algorithm/contact.h"

namespace runnel {

inline void Describe(TypeBuilder<Contact>& type) {
  type.Name("Contact")
      .SemanticTag("contact")
      .Field("is_touching", &Contact::is_touching)
      .Field("bearing", &Contact::bearing, {.unit = "rad"});
}

}  // namespace runnel
