// Components that are drawn again only if what they are given has changed.

import { Component, h } from 'preact';

export function memo(render) {
  class Memo extends Component {
    shouldComponentUpdate(next) {
      const names = Object.keys(next);
      return names.length !== Object.keys(this.props).length ||
        names.some((name) => next[name] !== this.props[name]);
    }

    render(properties) {
      return h(render, properties);
    }
  }
  return Memo;
}
