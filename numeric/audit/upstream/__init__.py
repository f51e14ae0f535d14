"""What goes to those who do not have faultspace: the checks as data, and one check as a script.

recipes       how answers are compared, in words
questions     what a check asks and what is due, taken from the check itself
exporting     a JSON file a check, with a schema, checksums and readers in other languages
reproducing   a script in another language, or numpy alone, that shows one failure
"""
