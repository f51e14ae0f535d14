"""Implementation against check: board.json and the pages made of it.

boards      the audits; `python -m faultspace.numeric.audit.scoreboard --out numeric/audit` writes all
records     what the file holds
pages       README's table and FINDINGS.md
"""
