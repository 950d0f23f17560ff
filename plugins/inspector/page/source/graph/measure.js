// How large the boxes of the graph are. Widths of texts are estimated, so that layout needs no page.

export const kRow = 20;         // a row of ports
export const kHeader = 42;      // name and type
export const kGroupHeader = 30; // of a group that is open
export const kPadding = 18;
export const kPicture = 130;    // of what a module draws, below its ports
export const kBars = 42;        // of how a behaviour is, below its ports
const kLetter = 6.75;           // mean width of a letter of a port's name
export const kNoteRow = 14;
const kNoteLetter = 5.9;
const kNoteLetters = 30;        // of a line
const kMostNoteLines = 4;
const kNameLetter = 8;

export function PortLabelWidth(ports) {
  return ports.reduce((widest, port) => Math.max(widest, port.name.length * kLetter), 0);
}

/** The box of a module, or of a group that is folded: {width, height}. */
export function BoxSize(name, detail, inputs, outputs, note = []) {
  const rows = Math.max(inputs.length, outputs.length);
  const labels = PortLabelWidth(inputs) + PortLabelWidth(outputs) + 42;
  const texts = Math.max(name.length * kNameLetter + 52, detail.length * kLetter + 30,
    ...note.map((line) => line.length * kNoteLetter + 28));
  const width = Math.round(Math.min(320, Math.max(136, labels, texts)));
  return { width, height: kHeader + rows * kRow + (rows > 0 ? 8 : 0) + NoteHeight(note) };
}

/** Height of the middle of a port in its box. */
export function PortHeight(index) {
  return kHeader + index * kRow + kRow / 2;
}

/** A note in lines as wide as a box; what is beyond the last one is cut. */
export function NoteLines(text) {
  if (!text) return [];
  const lines = [''];
  for (const word of text.split(/\s+/)) {
    const line = lines.at(-1);
    if (line !== '' && line.length + 1 + word.length > kNoteLetters) lines.push(word);
    else lines[lines.length - 1] = line === '' ? word : `${line} ${word}`;
  }
  const cut = lines.map((line) => (line.length > kNoteLetters + 6 ? `${line.slice(0, kNoteLetters + 5)}…` : line));
  return cut.length > kMostNoteLines ? [...cut.slice(0, kMostNoteLines - 1), `${cut[kMostNoteLines - 1]} …`] : cut;
}

export function NoteHeight(lines) {
  return lines.length > 0 ? lines.length * kNoteRow + 8 : 0;
}
