"""The view model: the records of a run, put into the order and the words in which a page shows them. It computes no verdict."""
