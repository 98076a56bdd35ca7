// SPDX-FileCopyrightText: 2026 the Q-WSM developers
// SPDX-License-Identifier: BSD-3-Clause
// Asks for a mark's words, or whether it is to be removed.
const $ = (id) => document.getElementById(id);

const capitalised = (word) => word[0].toUpperCase() + word.slice(1);

export class MarkDialog {
  #mark = null;

  // `tell(mark)` is called with what the operator has made of a mark; `closed()` in any case.
  constructor(tell, closed) {
    const dialog = $('mark-dialog');
    dialog.addEventListener('close', () => {
      if (dialog.returnValue === 'ok' || dialog.returnValue === 'remove') {
        tell({...this.#mark, text: $('mark-text').value.trim(), removed: dialog.returnValue === 'remove'});
      }
      closed();
    });
    // Enter keeps the mark: of a form's buttons it would choose the first.
    $('mark-text').addEventListener('keydown', (event) => {
      if (event.key !== 'Enter') return;
      event.preventDefault();
      dialog.close('ok');
    });
  }

  open(mark, {isNew}) {
    this.#mark = mark;
    const name = capitalised(mark.kind) + (mark.number ? ` ${mark.number}` : '');
    $('mark-title').textContent = `${name} at ${mark.x.toFixed(1)}, ${mark.y.toFixed(1)} m`;
    $('mark-text').value = mark.text;
    $('mark-remove').hidden = isNew;
    $('mark-dialog').returnValue = 'cancel';
    $('mark-dialog').showModal();
    $('mark-text').focus();
  }
}
