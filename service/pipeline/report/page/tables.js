// SPDX-FileCopyrightText: 2026 the Q-WSM developers
// SPDX-License-Identifier: BSD-3-Clause
//
// Tables that can be sorted by any column, and whose rows show their place.

// @param columns [{ name, of(row), text(row), number, style(row) }]; @param show is called with a row.
function sortedTable(label, columns, rows, show) {
  const body = make('tbody');
  let [by, down] = [-1, false];
  const fill = () => {
    const sorted = by < 0 ? rows : [...rows].sort((a, b) => {
      const [left, right] = [columns[by].of(a), columns[by].of(b)];
      return (left < right ? -1 : left > right ? 1 : 0) * (down ? -1 : 1);
    });
    body.replaceChildren(...sorted.map((row) => {
      const line = make('tr', {}, ...columns.map(({ text, number, style }) =>
        make('td', { class: [number ? 'number' : '', style ? style(row) : ''].join(' ').trim() || undefined }, text(row))));
      line.append(make('td', {}, make('button', { type: 'button', onclick: () => {
        for (const other of body.children) other.classList.toggle('chosen', other === line);
        show(row);
      } }, 'Show')));
      return line;
    }));
  };
  const heads = columns.map(({ name, number }, i) => {
    const head = make('th', { scope: 'col', class: number ? 'number' : undefined, 'aria-sort': 'none' });
    head.append(make('button', { type: 'button', title: 'Sort by this column', onclick: () => {
      [by, down] = [i, by === i ? !down : Boolean(number)];
      for (const other of head.parentElement.children) other.setAttribute('aria-sort', 'none');
      head.setAttribute('aria-sort', down ? 'descending' : 'ascending');
      fill();
    } }, name));
    return head;
  });
  fill();
  return make('div', { class: 'scroll', tabindex: 0, role: 'region', 'aria-label': label },
    make('table', {}, make('thead', {}, make('tr', {}, ...heads, make('th', { scope: 'col' }, 'Where'))), body));
}
