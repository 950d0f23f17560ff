// How large the boxes of the graph are. Widths of texts are estimated, so that layout needs no page.

export const kRow = 20;         // a row of ports
export const kHeader = 42;      // name and type
export const kGroupHeader = 30; // of a group that is open
export const kPadding = 18;
export const kPicture = 130;    // of what a module draws, below its ports
const kLetter = 6.2;            // mean width of a letter of a port's name
const kNameLetter = 7.4;

export function PortLabelWidth(ports) {
  return ports.reduce((widest, port) => Math.max(widest, port.name.length * kLetter), 0);
}

/** The box of a module, or of a group that is folded: {width, height}. */
export function BoxSize(name, detail, inputs, outputs) {
  const rows = Math.max(inputs.length, outputs.length);
  const labels = PortLabelWidth(inputs) + PortLabelWidth(outputs) + 42;
  const texts = Math.max(name.length * kNameLetter + 52, detail.length * kLetter + 30);
  const width = Math.round(Math.min(320, Math.max(136, labels, texts)));
  return { width, height: kHeader + rows * kRow + (rows > 0 ? 8 : 0) };
}

/** Height of the middle of a port in its box. */
export function PortHeight(index) {
  return kHeader + index * kRow + kRow / 2;
}
