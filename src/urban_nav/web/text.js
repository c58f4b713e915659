// SPDX-License-Identifier: BSD-3-Clause
// Elements of the page. Text from outside becomes text nodes and attributes, never markup.
"use strict";
((nav) => {
  /** Returns an element: properties beginning with data- or aria-, role and for are attributes; children may be texts. */
  nav.element = (tag, properties = {}, ...children) => {
    const made = document.createElement(tag);
    for (const [name, value] of Object.entries(properties)) {
      if (/^(data-|aria-|role$|for$)/.test(name)) made.setAttribute(name, value);
      else made[name] = value;
    }
    made.append(...children);
    return made;
  };

  /** Brings the children of an element in line with a list; rows that stay are kept, so that focus and scrolling do. `key`
   * of an item; `create` returns its row, `update(row, item)` fills it. */
  nav.syncRows = (parent, items, key, create, update) => {
    const known = new Map([...parent.children].map((row) => [row.dataset.key, row]));
    let next = parent.firstElementChild;
    for (const item of items) {
      const name = String(key(item));
      let row = known.get(name);
      if (!row) {
        row = create(item);
        row.dataset.key = name;
      }
      known.delete(name);
      update(row, item);
      if (row === next) next = next.nextElementSibling;
      else parent.insertBefore(row, next);
    }
    for (const row of known.values()) row.remove();
  };

  /** Sets an attribute or property only if it differs, which saves layout by the browser. */
  nav.put = (node, name, value) => {
    if (node.getAttribute(name) !== value) node.setAttribute(name, value);
  };
  nav.putText = (node, text) => {
    if (node.textContent !== text) node.textContent = text;
  };
})((globalThis.urbanNav ??= {}));
