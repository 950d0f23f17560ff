// What a page asks its reader to do: the blocks of code in it, by what they are.
//
//     ```sh                    commands, all of a page in one shell, one after the other
//     ```text behind it        what they print: these lines, in this order; … stands for anything
//     <!-- file: NAME -->      the block behind it is what the file has
//     <!-- from: NAME -->      the block behind it is a part of that file, which is there already
//     <!-- not run: WHY -->    the block behind it is not for tests
//
// Commands stand in blocks of their own: where four blanks make a block, nobody would run them. READMEs also show
// parts of things, and drawings, which are nobody's; but no command, nor what is whole.

const kCommand = /^ {4,}(\$ )?(sudo |[A-Z_]+=\S+ )*(runnel|cmake|ninja|ctest|npm|node|apt-get|\.{1,2}\/\S+|(bin|bench)\/\S+)( |$)/;
const kWhole = /^(#include |<application |cmake_minimum_required)/m;
const kMark = /^<!-- (file|from|not run): (.+?) -->$/;

/** {kind: 'run' | 'output' | 'file' | 'from' | 'not run' | 'part' | 'unknown', name, line, text} in the order of the page. */
export function BlocksOf(page) {
  const blocks = [];
  let mark = null;
  let open = null;
  let indented = false; // in a block that four blanks make, of which is known what it is
  page.split('\n').forEach((line, index) => {
    if (open) {
      if (line !== '```') return open.lines.push(line);
      blocks.push(Block(open, blocks.at(-1)));
      open = null;
      mark = null;
    } else if (line.startsWith('```')) {
      indented = false;
      open = { language: line.slice(3).split(' ')[0], mark, line: index + 1, lines: [] };
    } else if (kCommand.test(line) && !indented) {
      indented = true;
      blocks.push({ kind: mark?.kind === 'not run' ? 'not run' : 'unknown', line: index + 1, text: line });
      mark = null;
    } else if (kMark.test(line)) {
      const [, kind, name] = line.match(kMark);
      mark = { kind, name };
      indented = false;
    } else if (line.trim() !== '' && !line.startsWith('    ')) {
      mark = null;
      indented = false;
    }
  });
  if (open) throw new Error(`${open.line}: the block does not end`);
  return blocks;
}

function Block({ language, mark, line, lines }, before) {
  const text = lines.join('\n') + '\n';
  if (mark) return { ...mark, line, text };
  if (language === 'sh') return { kind: 'run', line, text };
  if (language === 'text' && before?.kind === 'run') return { kind: 'output', line, text };
  return { kind: kWhole.test(text) ? 'unknown' : 'part', line, text };
}

/** The first block that nobody runs and that does not say why. */
export function FirstUnknown(page, isReadme) {
  return BlocksOf(page).find(({ kind }) => kind === 'unknown' || (kind === 'part' && !isReadme));
}

/** The first line that is expected and has not been printed after those before it; undefined if all have. */
export function FirstMissing(expected, printed) {
  const lines = printed.split('\n');
  let at = 0;
  return expected.split('\n').filter((line) => line.trim() !== '' && line.trim() !== '…').find((line) => {
    const pattern = new RegExp(line.trimEnd().split('…').map((part) => part.replace(/[.*+?^${}()|[\]\\]/g, '\\$&')).join('.*'));
    while (at < lines.length) if (pattern.test(lines[at++])) return false;
    return true;
  });
}
