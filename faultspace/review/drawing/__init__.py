"""What a page draws: matrices and numbers as MathML, charts and the graph of claims as SVG that follows the page's colours."""
