// SPDX-FileCopyrightText: 2026 the Q-WSM developers
// SPDX-License-Identifier: BSD-3-Clause
// Asks for a mark's words, or whether it is to be removed.
const $ = (id) => document.getElementById(id);

const capitalised = (word) => word[0].toUpperCase() + word.slice(1);

export class MarkDialog {
  #mark = null;
  #isNew = true;

  // `tell(mark)` is called with what the operator has made of a mark, and says whether that is on its way; `closed()` in the end.
  constructor(tell, closed) {
    const dialog = $('mark-dialog');
    dialog.addEventListener('close', () => {
      if (dialog.returnValue === 'ok' || dialog.returnValue === 'remove') {
        const mark = {...this.#mark, text: $('mark-text').value.trim()};
        if (!tell({...mark, removed: dialog.returnValue === 'remove'})) return this.#openAgain(mark);
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

  // What was typed must not be lost with the line.
  #openAgain(mark) {
    this.open(mark, {isNew: this.#isNew});
    $('mark-trouble').textContent = 'There is no word from a service that could keep that; try again when there is.';
    $('mark-trouble').hidden = false;
  }

  open(mark, {isNew}) {
    this.#mark = mark;
    this.#isNew = isNew;
    $('mark-trouble').hidden = true;
    const name = capitalised(mark.kind) + (mark.number ? ` ${mark.number}` : '');
    $('mark-title').textContent = `${name} at ${mark.x.toFixed(1)}, ${mark.y.toFixed(1)} m`;
    $('mark-text').value = mark.text;
    $('mark-remove').hidden = isNew;
    $('mark-dialog').returnValue = 'cancel';
    $('mark-dialog').showModal();
    $('mark-text').focus();
  }
}
