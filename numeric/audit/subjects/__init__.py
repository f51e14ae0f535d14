"""Who is put through the checks, and where it runs.

opening               an object here, an adapter by its name, a program, a published package
isolation, worker     an adapter in a process of its own, and what runs in it
subprocess_adapter    an implementation in any language, behind JSON lines
programs              a program asked by lines under limits
"""
