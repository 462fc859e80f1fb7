// SPDX-License-Identifier: BSD-3-Clause

// What this folder throws, and all that it throws: one sentence that says what was found, what was expected
// and what can be done.
export class ReliefError extends Error
{
  constructor(message)
  {
    super(message);
    this.name = 'ReliefError';
  }
}
