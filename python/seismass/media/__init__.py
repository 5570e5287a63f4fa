"""Figures, cards, pages, tables of text and folders as such. It knows no building and no result."""
