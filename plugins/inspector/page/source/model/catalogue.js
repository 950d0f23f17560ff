// What the plugins of the application offer: module types and data types.

export class Catalogue {
  constructor(message = { modules: [], types: [] }) {
    this.modules = message.modules;
    this.types = new Map(message.types.map((type) => [type.name, type]));
    this.moduleByType = new Map(message.modules.map((module) => [module.type, module]));
  }

  type(name) {
    return this.types.get(name);
  }

  module(type) {
    return this.moduleByType.get(type);
  }

  /** Whether values of a type have no text form: only modules can read them. */
  isOpaque(name) {
    return this.types.get(name)?.kind === 'opaque';
  }

  /** What values of a type stand for, so that they can be drawn: "pose", "range_scan" … or "". */
  meaning(name) {
    return this.types.get(name)?.meaning ?? '';
  }

  /** The module types in which all words occur, those with the words in their name first. */
  search(text) {
    const words = text.toLowerCase().split(/\s+/).filter(Boolean);
    const found = [];
    for (const module of this.modules) {
      const name = module.type.toLowerCase();
      const all = `${name} ${module.summary ?? ''}`.toLowerCase();
      if (!words.every((word) => all.includes(word))) continue;
      found.push({ module, rank: words.every((word) => name.includes(word)) ? 0 : 1 });
    }
    found.sort((a, b) => a.rank - b.rank || a.module.type.localeCompare(b.module.type));
    return found.map((entry) => entry.module);
  }
}
