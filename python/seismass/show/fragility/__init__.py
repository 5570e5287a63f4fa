"""How an analysis of fragility looks."""
