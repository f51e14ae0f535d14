"""What goes to those who do not have faultspace: the checks as data, and one check as a script.

questions     what a check asks and what is due, taken from the check itself
exporting     a JSON file a check, with a schema, checksums, readers in other languages, and how answers are compared in words
reproducing   a script in another language, or numpy alone, that shows one failure;   languages: how each is written
"""
