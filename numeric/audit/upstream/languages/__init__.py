"""How a script that shows a check is written in each language.

writing   what a language has to say: literals, calls, comparisons
python, matrices, julia   Python with numpy alone; Octave and MATLAB, which share a text; Julia
growing   scripts on records too long to stand in them, in Python
"""
