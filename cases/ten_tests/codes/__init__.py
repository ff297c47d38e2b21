"""One module a code: `version()` or None where it is not installed, `TESTS` that there are decks for, `answer(test, folder)`."""
