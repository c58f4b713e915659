// SPDX-License-Identifier: BSD-3-Clause
// Why a closure has its verdict: sentences, pictures and tables of `urban_nav why`.
"use strict";
((nav) => {
  /** A text that begins with a closure is a button that selects it. */
  const content = (text) => {
    const found = /^closure (\d+)\b/.exec(text);
    return found ? nav.element("button", {type: "button", className: "link", "data-closure": found[1]}, text) : text;
  };
  const table = (given) => {
    const row = (cells, tag) => nav.element("tr", {}, ...cells.map((cell) => nav.element(tag, {}, content(cell))));
    return [
      ...(given.title ? [nav.element("h3", {}, given.title)] : []),
      nav.element(
        "table",
        {},
        nav.element("thead", {}, row(given.head, "th")),
        nav.element("tbody", {}, ...given.rows.map((cells) => row(cells, "td"))),
      ),
      ...(given.caption ? [nav.element("p", {className: "hint"}, given.caption)] : []),
    ];
  };

  /** Fills an element with an explanation. `load(number)` returns a picture as a blob, or null. Returns when all is shown. */
  nav.showExplanation = async (parent, page, load) => {
    for (const image of parent.querySelectorAll("img")) URL.revokeObjectURL(image.src);
    const pictures = [],
      children = [nav.element("p", {}, page.subtitle)];
    for (const verdict of page.verdicts)
      children.push(nav.element("p", {}, nav.element("b", {}, verdict.headline), " ", verdict.sentence));
    for (const tile of page.tiles) children.push(nav.element("p", {}, tile));
    for (const section of page.sections) {
      children.push(nav.element("h3", {}, section.title));
      if (section.introduction) children.push(nav.element("p", {}, section.introduction));
      for (const picture of section.pictures) {
        const image = nav.element("img", {alt: picture.caption, width: picture.width, height: picture.height});
        pictures.push([image, picture.number]);
        children.push(image, nav.element("p", {className: "hint"}, picture.caption));
      }
      for (const each of section.tables) children.push(...table(each));
    }
    parent.replaceChildren(...children);
    parent.scrollTop = 0;
    for (const [image, number] of pictures) {
      const blob = await load(number);
      if (!image.isConnected) return;
      if (!blob) {
        image.remove();
        continue;
      }
      image.src = URL.createObjectURL(blob);
      await image.decode().catch(() => image.remove());
    }
  };
})((globalThis.urbanNav ??= {}));
