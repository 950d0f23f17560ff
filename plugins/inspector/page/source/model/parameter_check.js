// What can be said of a parameter's new value before the application is asked.

const kWhole = /^u?int(8|16|32|64)?(_t)?$|^size_t$/;
const kReal = /^(double|float)$/;

/** What is wrong with `text`, or "". */
export function CheckValue(parameter, text, catalogue) {
  const { data_type: type, minimum, maximum, unit } = parameter;
  const values = catalogue.type(type)?.values;
  if (values?.length > 0) return values.includes(text) ? '' : `one of ${values.join(', ')} is needed`;
  if (!kWhole.test(type) && !kReal.test(type)) return '';
  const trimmed = text.trim();
  const number = Number(trimmed);
  const isSpecial = /^[+-]?(nan|inf|infinity)$/i.test(trimmed);
  if (isSpecial) return kReal.test(type) ? '' : 'a whole number is needed';
  if (trimmed === '' || Number.isNaN(number)) return `'${trimmed}' is not a number`;
  if (kWhole.test(type) && !Number.isInteger(number)) return 'a whole number is needed';
  const suffix = unit ? ` ${unit}` : '';
  if (minimum !== null && minimum !== undefined && number < minimum) return `at least ${minimum}${suffix} is needed`;
  if (maximum !== null && maximum !== undefined && number > maximum) return `at most ${maximum}${suffix} is allowed`;
  return '';
}

/** What is wrong with the text of a number that is needed, or "": it is finite, and in bounds. */
export function CheckNumber(text, { isWhole = false, ...bounds }) {
  const trimmed = text.trim();
  if (trimmed === '' || !Number.isFinite(Number(trimmed))) return `'${trimmed}' is not a number`;
  return CheckValue({ data_type: isWhole ? 'int' : 'double', ...bounds }, trimmed, kNoTypes);
}

const kNoTypes = { type: () => undefined };
