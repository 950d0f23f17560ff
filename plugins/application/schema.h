#pragma once

#include <string>

#include "core/base/error.h"
#include "core/plugin/module_registry.h"
#include "plugins/application_files/xml_tag.h"

namespace runnel {

/// An XML schema (XSD 1.0) of application files: the tags and attributes that `tags` knows, the
/// types that `modules` knows, their parameters and the types of their ports. Editors complete by it
/// and check; so does `xmllint --schema`. It accepts every file that loads, and refuses most of those
/// that do not: it cannot follow paths, nor tell which parameter belongs to which type.
///
/// The same registries give the same text. Makes one module of each type, away from any application.
///
/// Errors: go to `diagnostics`: types of which no module can be made; their names are in the schema.
[[nodiscard]] std::string SchemaText(const XmlTagRegistry& tags, const ModuleRegistry& modules,
                                     Diagnostics& diagnostics);

}  // namespace runnel
