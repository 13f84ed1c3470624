// Short ways to find and make elements of the page.

/// The element with that id.
export function byId(id) {
  return document.getElementById(id);
}

/// Opens a panel and scrolls to it, unless it is seen. True if it was not.
export function showPanel(panel) {
  const margin = 60;
  const list = byId('sections').getBoundingClientRect();
  const { top, bottom } = panel.getBoundingClientRect();
  const seen = panel.open && top < list.bottom - margin && bottom > list.top + margin;
  panel.open = true;
  if (!seen) scrollToPanel(panel);
  return !seen;
}

/// Scrolls the list of panels alone; scrollIntoView() would move the bar out of the window, too.
export function scrollToPanel(panel) {
  const list = byId('sections');
  list.scrollTop += panel.getBoundingClientRect().top - list.getBoundingClientRect().top;
}

/// A new element. Attributes that are false or null are left out; "text" is its text.
export function element(tag, attributes = {}, ...children) {
  return fill(document.createElement(tag), attributes, children);
}

/// The same for a shape inside of an <svg>.
export function shape(tag, attributes = {}) {
  return fill(document.createElementNS('http://www.w3.org/2000/svg', tag), attributes, []);
}

/// Presses one button of a group and releases the others: pressOne(buttons, 'tool', 'crop').
export function pressOne(buttons, key, value) {
  for (const button of buttons) {
    button.setAttribute('aria-pressed', String(button.dataset[key] === value));
  }
}

/// Makes the options of a select anew if they changed; keeps what is chosen. Items: [value, text].
export function setOptions(select, items) {
  const key = JSON.stringify(items);
  if (select.dataset.items === key) return;
  select.dataset.items = key;
  const chosen = select.value;
  select.replaceChildren(...items.map(([value, text]) => element('option', { value, text })));
  if (items.some(([value]) => value === chosen)) select.value = chosen;
}

/// Fills a <dl> with [name, value] pairs. Those whose value is none are left out; 0 is one.
export function setFigures(list, pairs) {
  const shown = pairs.filter(([, value]) => value || value === 0);
  list.replaceChildren(...shown.flatMap(
    ([name, value]) => [element('dt', { text: name }), element('dd', { text: value })]));
}

function fill(made, attributes, children) {
  for (const [name, value] of Object.entries(attributes)) {
    if (value === false || value === null || value === undefined) continue;
    if (name === 'text') made.textContent = value;
    else made.setAttribute(name, value === true ? '' : value);
  }
  made.append(...children);
  return made;
}
