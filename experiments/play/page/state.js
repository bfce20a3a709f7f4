'use strict';

// What the reader chose, kept in the address (#model=horse&log=0&hide=draco) so that a link shows the same picture.
const State = (() => {
  const defaults = {};
  const listeners = [];
  let values = {};

  const read = () => {
    const given = new URLSearchParams(location.hash.slice(1));
    values = {};
    for (const [name, value] of given) if (name in defaults) values[name] = value;
  };

  // Browsers take some twenty changes of the address a second, and warn beyond; a slider makes more. The last one counts.
  const recent = [];
  let later = null;
  const write = () => {
    const now = performance.now(), kMost = 10;
    if (recent.length === kMost && now - recent[0] < 1000) {
      later ||= setTimeout(() => { later = null; write(); }, 200);
      return;
    }
    if (recent.push(now) > kMost) recent.shift();
    const parameters = new URLSearchParams();
    for (const name of Object.keys(defaults))
      if (name in values && values[name] !== defaults[name]) parameters.set(name, values[name]);
    const text = parameters.toString();
    history.replaceState(null, '', text ? '#' + text : location.pathname + location.search);
  };

  const changed = () => listeners.forEach((listener) => listener());

  window.addEventListener('hashchange', () => { read(); changed(); });

  return {
    declare(name, value) { defaults[name] = String(value); },
    start() { read(); changed(); },
    get: (name) => (name in values ? values[name] : defaults[name]),
    flag: (name) => State.get(name) === '1',
    list: (name) => State.get(name).split('|').filter(Boolean),
    set(name, value) { values[name] = String(value); write(); changed(); },
    on(listener) { listeners.push(listener); },
  };
})();

const byId = (id) => document.getElementById(id);

function element(name, attributes = {}, ...children) {
  const svg = ['svg', 'g', 'path', 'line', 'circle', 'text', 'rect'].includes(name);
  const node = svg ? document.createElementNS('http://www.w3.org/2000/svg', name) : document.createElement(name);
  for (const [key, value] of Object.entries(attributes)) node.setAttribute(key, value);
  node.append(...children);
  return node;
}

// A row of buttons of which one is pressed; `name` is what it sets.
function choice(host, name, options, chosen) {
  host.replaceChildren(...options.map(([value, text]) => {
    const button = element('button', { type: 'button', 'data-value': value, 'aria-pressed': value === chosen }, text);
    button.addEventListener('click', () => State.set(name, value));
    return button;
  }));
  host.hidden = options.length < 2;
}

const dbText = (db, digits) => (db === Infinity ? 'exact' : db.toFixed(digits));

const bytesText = (bytes) =>
  bytes < 1024 ? `${bytes} B` : bytes < 1048576 ? `${+(bytes / 1024).toPrecision(3)} KB` : `${+(bytes / 1048576).toPrecision(3)} MB`;
