// Arguments of a service as one text, from what has been written into the fields of its form.

/** `service`: as the port has it; `values`: by the names of its fields, '' for the only argument. */
export function CallArguments(service, values) {
  if (!service.fields) return values[''] ?? service.value ?? '';
  return `{${service.fields.map((field) => {
    const value = values[field.name] ?? field.value;
    return `${field.name}: ${field.data_type === 'string' ? JSON.stringify(value) : value}`;
  }).join(', ')}}`;
}

/** What a form asks for: [{name, data_type, unit, description, value}]. */
export function FormFields(service) {
  if (service.fields) return service.fields;
  return service.arguments ? [{ name: '', data_type: service.arguments, unit: '', description: '', value: service.value ?? '' }] : [];
}
