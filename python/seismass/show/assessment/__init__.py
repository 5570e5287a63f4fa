"""How the assessment of a building looks: words, tables, figures, page."""
