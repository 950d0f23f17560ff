// The numbers in values of a type, by their names: "forward", "position.x". Of lists, whose length no type tells, none.

const kDepth = 4;
const kNumber = /^(double|float|bool|u?int(8|16|32|64)?(_t)?)$/;

/** [{field: "position.x", unit}], "" for a type that is a number itself. */
export function NumberFields(catalogue, typeName, unit = '', path = [], found = []) {
  const type = catalogue.type(typeName);
  if (kNumber.test(typeName)) found.push({ field: path.join('.'), unit });
  else if (type?.kind === 'structure' && path.length < kDepth) {
    for (const field of type.fields ?? []) NumberFields(catalogue, field.type, field.unit ?? '', [...path, field.name], found);
  }
  return found;
}

/** All parts of a value that have a name, numbers or not. */
export function PartFields(catalogue, typeName) {
  return (catalogue.type(typeName)?.fields ?? []).map(({ name, unit }) => ({ field: name, unit: unit ?? '' }));
}

/** "position.x" as steps into a value. */
export function StepsOf(field) {
  return field ? field.split('.') : [];
}

export function UnitOf(catalogue, port, field) {
  if (!port) return '';
  if (!field) return port.unit ?? '';
  return NumberFields(catalogue, port.data_type).find((each) => each.field === field)?.unit ??
    PartFields(catalogue, port.data_type).find((each) => each.field === field)?.unit ?? '';
}
